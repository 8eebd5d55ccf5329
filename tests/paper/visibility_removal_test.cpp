// SPDX-License-Identifier: MIT
#include "paper/visibility_removal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/random.hpp"

namespace dynamic_filter {
namespace visibility_removal_test {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// An image that saw the same range everywhere.
RangeImage everywhere(float range) {
    const ImageGrid grid = make_grid(0.1F, 0.1F, -1.57F, 1.57F);
    return {grid, std::vector<float>(grid.size(), range)};
}

/// Two scans, each a keyframe at the origin; the first holds the points.
Window two_scans(const Points& points) {
    Window window;
    window.scans.resize(2);
    window.scans[0].points = points;
    window.keyframes = {0, 1};
    return window;
}

/// The verdicts on the first scan's points if the second one saw `boundary` everywhere.
Labels seen_against(const Points& points, float boundary, const RemovalMargin& margin) {
    const std::vector<RangeImage> images{everywhere(kInf), everywhere(boundary)};
    return remove_by_visibility(two_scans(points), images, margin)[0];
}

Window random_window(test::Random& random) {
    Window window;
    for (int s = 0; s < 4; ++s) {
        Scan scan;
        scan.points = random.points(1500, 10.0);
        scan.T_world_sensor = random.pose(2.0, 1.0);
        window.scans.push_back(scan);
    }
    window.keyframes = {0, 2, 3};
    return window;
}

/// Judges a point by one image: true dynamic, false no evidence, empty too close to call.
std::optional<bool> by_hand(const Eigen::Vector3d& p, const RangeImage& image,
                            const RemovalMargin& margin) {
    const ImageGrid& g = image.grid;
    const double u = (std::atan2(p.y(), p.x()) + std::numbers::pi) / g.azimuth_step;
    const double v = (std::asin(p.z() / p.norm()) - g.elevation_min) / g.elevation_step;
    const double border = std::min(std::abs(u - std::round(u)), std::abs(v - std::round(v)));
    if (border < 0.01 || p.norm() < 0.3) return std::nullopt;
    if (v < 0.0 || v >= g.rows) return false;
    const float boundary =
        image
            .range[static_cast<std::size_t>(static_cast<int>(v) * g.columns + static_cast<int>(u))];
    if (boundary == kInf) return false;
    const double excess = boundary - p.norm() - (margin.tau + margin.per_metre * p.norm());
    if (std::abs(excess) < 1e-4) return std::nullopt;
    return excess > 0.0;
}

TEST(KeyframeImages, AreThoseOfTheKeyframesInTheirOwnFrames) {
    test::Random random(1);
    const Window window = random_window(random);
    const auto images = keyframe_images(window, 0.1F, 0.05F);
    ASSERT_EQ(images.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        const Points& points = window.scans[window.keyframes[k]].points;
        const auto [low, high] = elevation_range(points);
        const RangeImage expected = nearest_range_image(points, make_grid(0.1F, 0.05F, low, high));
        EXPECT_EQ(images[k].range, expected.range);
        EXPECT_EQ(images[k].grid.elevation_min, expected.grid.elevation_min);
        Projection own;
        project(points, Eigen::Isometry3f::Identity(), images[k].grid, own);
        for (const auto pixel : own.pixel) ASSERT_GE(pixel, 0);
    }
}

TEST(VisibilityRemoval, AgreesWithADoubleLoop) {
    test::Random random(2);
    for (int repeat = 0; repeat < 5; ++repeat) {
        const Window window = random_window(random);
        const auto images = keyframe_images(window, 0.2F, 0.1F);
        const RemovalMargin margin{0.2F, 0.05F};
        const auto labels = remove_by_visibility(window, images, margin);
        int dynamic = 0, still = 0;
        for (std::size_t s = 0; s < window.scans.size(); ++s) {
            for (std::size_t i = 0; i < window.scans[s].points.size(); ++i) {
                bool seen_through = false, clear = true;
                for (std::size_t k = 0; k < images.size(); ++k) {
                    if (window.keyframes[k] == s) continue;
                    const Pose& T_map_keyframe = window.scans[window.keyframes[k]].T_world_sensor;
                    const auto verdict = by_hand(
                        T_map_keyframe.inverse() * (window.scans[s].T_world_sensor *
                                                    window.scans[s].points[i].cast<double>()),
                        images[k], margin);
                    clear &= verdict.has_value();
                    seen_through |= verdict.value_or(false);
                }
                if (!clear) continue;
                ASSERT_EQ(labels[s][i], seen_through ? Label::dynamic : Label::static_)
                    << s << " " << i;
                ++(seen_through ? dynamic : still);
            }
        }
        EXPECT_GT(dynamic, 100);
        EXPECT_GT(still, 100);
    }
}

TEST(VisibilityRemoval, PointsBehindTheBoundaryAreNeverRemoved) {
    test::Random random(3);
    Points points;
    for (int i = 0; i < 2000; ++i) {
        points.push_back((random.direction() * random.uniform(5.0, 80.0)).cast<float>());
    }
    for (const Label label : seen_against(points, 5.0F, {})) EXPECT_EQ(label, Label::static_);
    for (const Label label : seen_against(points, 81.0F, {})) EXPECT_EQ(label, Label::dynamic);
}

TEST(VisibilityRemoval, AnEmptyPixelIsNoEvidence) {
    EXPECT_EQ(seen_against({{3, 0.1F, 0}}, kInf, {})[0], Label::static_);
}

TEST(VisibilityRemoval, AtTheMarginExactlyAPointStays) {
    const Points points{{8, 0, 0}};
    EXPECT_EQ(seen_against(points, 10.0F, {2.0F, 0.0F})[0], Label::static_);
    EXPECT_EQ(seen_against(points, 10.0F, {0.0F, 0.25F})[0], Label::static_);
    EXPECT_EQ(seen_against(points, 10.0F, {1.0F, 0.125F})[0], Label::static_);
    EXPECT_EQ(seen_against(points, std::nextafter(10.0F, kInf), {1.0F, 0.125F})[0], Label::dynamic);
}

TEST(VisibilityRemoval, AKeyframeDoesNotJudgeItsOwnPoints) {
    const std::vector<RangeImage> images{everywhere(50.0F), everywhere(kInf)};
    EXPECT_EQ(remove_by_visibility(two_scans({{3, 0.1F, 0}}), images, {})[0][0], Label::static_);
}

TEST(VisibilityRemoval, OneKeyframeThatSawThroughIsEnough) {
    Window window;
    window.scans.resize(4);
    window.scans[0].points = {{3, 0.1F, 0}, {-3, 0.1F, 0}, {0.1F, 3, 0}};
    window.keyframes = {1, 2, 3};
    std::vector<RangeImage> images{everywhere(kInf), everywhere(kInf), everywhere(1.0F)};
    Projection seen;  // the first image sees through point 0 only, the second through point 1 only
    project(window.scans[0].points, Eigen::Isometry3f::Identity(), images[0].grid, seen);
    images[0].range[static_cast<std::size_t>(seen.pixel[0])] = 9.0F;
    images[1].range[static_cast<std::size_t>(seen.pixel[1])] = 9.0F;
    const auto labels = remove_by_visibility(window, images, {0.2F, 0.05F});
    EXPECT_EQ(labels[0], (Labels{Label::dynamic, Label::dynamic, Label::static_}));
}

TEST(VisibilityRemoval, ScansThatAreNoKeyframesAreJudgedToo) {
    Window window = two_scans({});
    window.scans[1].points = {{3, 0.1F, 0}};
    window.keyframes = {0};
    const std::vector<RangeImage> images{everywhere(9.0F)};
    EXPECT_EQ(remove_by_visibility(window, images, {})[1][0], Label::dynamic);
}

TEST(VisibilityRemoval, LooksFromThePoseOfTheKeyframe) {
    Window window = two_scans({{3, 0.1F, 0}});
    window.scans[1].T_world_sensor.translation().x() = -6.0;  // 9 m away from there
    const std::vector<RangeImage> images{everywhere(kInf), everywhere(9.0F)};
    EXPECT_EQ(remove_by_visibility(window, images, {0.1F, 0.0F})[0][0], Label::static_);
    window.scans[1].T_world_sensor.translation().x() = 6.0;  // 3 m
    EXPECT_EQ(remove_by_visibility(window, images, {0.1F, 0.0F})[0][0], Label::dynamic);
}

TEST(VisibilityRemoval, WhatWasNotMeasuredIsUnknown) {
    const Points points{{0, 0, 0}, {kNan, 1, 1}, {1, kInf, 1}, {1, 1, 1}};
    const Labels expected{Label::unknown, Label::unknown, Label::unknown, Label::dynamic};
    EXPECT_EQ(seen_against(points, 50.0F, {}), expected);
}

TEST(VisibilityRemoval, WithoutImagesEveryMeasuredPointIsStill) {
    const auto labels = remove_by_visibility(two_scans({{1, 2, 3}, {0, 0, 0}}), {}, {});
    ASSERT_EQ(labels.size(), 2U);
    EXPECT_EQ(labels[0], (Labels{Label::static_, Label::unknown}));
    EXPECT_TRUE(labels[1].empty());
}

TEST(RemovalMargin, GrowsWithTheRange) {
    const RemovalMargin margin{0.5F, 0.25F};
    EXPECT_EQ(margin.at(0.0F), 0.5F);
    EXPECT_EQ(margin.at(4.0F), 1.5F);
}

}  // namespace visibility_removal_test
}  // namespace dynamic_filter
