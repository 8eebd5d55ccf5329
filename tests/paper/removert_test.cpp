// SPDX-License-Identifier: MIT
#include "paper/removert.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>

#include "paper/submap.hpp"
#include "support/random.hpp"

namespace dynamic_filter {
namespace removert_test {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kVoxel = 0.2F;
constexpr RemovalMargin kMargin{0.2F, 0.05F};

RangeImage everywhere(float range) {
    const ImageGrid grid = make_grid(0.1F, 0.1F, -1.57F, 1.57F);
    return {grid, std::vector<float>(grid.size(), range)};
}

/// One scan with these points and a keyframe at the origin.
Window window_of(const Points& points) {
    Window window;
    window.scans.resize(1);
    window.scans[0].points = points;
    window.keyframes = {0};
    return window;
}

Labels removert_of(const Points& points, float fine, float coarse) {
    const std::array<KeyframeImages, 1> images{{{everywhere(fine)}}};
    return removert(window_of(points), images, {everywhere(coarse)}, kMargin, kVoxel)[0];
}

Window random_window(test::Random& random) {
    Window window;
    for (int s = 0; s < 3; ++s) {
        Scan scan;
        scan.points = random.points(1500, 8.0);
        scan.points[7] = Point::Zero();
        scan.T_world_sensor = random.pose(1.0, 1.0);
        window.scans.push_back(scan);
    }
    window.keyframes = {0, 1, 2};
    return window;
}

/// Looks at every half voxel's first point among those labelled `kept`, nearest per pixel only.
/// Returns the cells that some image saw through.
std::map<VoxelKey, bool> marked_by_hand(const Window& window, const std::vector<Labels>& labels,
                                        Label kept, const KeyframeImages& images) {
    Thinner thinner(kVoxel);
    Points points;
    for (std::size_t s = 0; s < window.scans.size(); ++s) {
        to_map(window.scans[s], points);
        thinner.add(points, labels[s], kept);
    }
    std::map<VoxelKey, bool> marked;
    const auto cell = [](const Point& p) { return pack(*cell_of(p, 2.0F / kVoxel)); };
    for (const Point& p : thinner.points()) marked[cell(p)] = false;
    for (std::size_t k = 0; k < images.size(); ++k) {
        Projection seen;
        const Pose& T_map_keyframe = window.scans[window.keyframes[k]].T_world_sensor;
        project(thinner.points(), T_map_keyframe.inverse().cast<float>(), images[k].grid, seen);
        for (std::size_t i = 0; i < seen.pixel.size(); ++i) {
            if (seen.pixel[i] < 0) continue;
            bool nearest = true;
            for (std::size_t j = 0; j < seen.pixel.size(); ++j) {
                if (seen.pixel[j] == seen.pixel[i] && seen.range[j] < seen.range[i])
                    nearest = false;
            }
            const float boundary = images[k].range[static_cast<std::size_t>(seen.pixel[i])];
            if (nearest && boundary < kInf &&
                boundary - seen.range[i] > kMargin.at(seen.range[i])) {
                marked[cell(thinner.points()[i])] = true;
            }
        }
    }
    return marked;
}

TEST(RevertByVisibility, TakesBackExactlyTheCellsThatNoCoarseImageMarksAgain) {
    test::Random random(1);
    const Window window = random_window(random);
    const auto before =
        remove_by_visibility(window, keyframe_images(window, 0.05F, 0.05F), kMargin);
    const KeyframeImages coarse = keyframe_images(window, 0.2F, 0.2F);
    const auto marked = marked_by_hand(window, before, Label::dynamic, coarse);
    auto labels = before;
    revert_by_visibility(window, coarse, kMargin, kVoxel, labels);
    std::map<Label, int> after;
    for (std::size_t s = 0; s < 3; ++s) {
        Points points;
        to_map(window.scans[s], points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (before[s][i] != Label::dynamic) {
                ASSERT_EQ(labels[s][i], before[s][i]);
                continue;
            }
            const bool again = marked.at(pack(*cell_of(points[i], 2.0F / kVoxel)));
            ASSERT_EQ(labels[s][i], again ? Label::dynamic : Label::static_);
            ++after[labels[s][i]];
        }
    }
    EXPECT_GT(after[Label::static_], 50);
    EXPECT_GT(after[Label::dynamic], 50);
}

TEST(Removert, RemovesWhatBothTheFineAndTheCoarseImageSeeThrough) {
    const Points points{{3, 0.1F, 0}};
    EXPECT_EQ(removert_of(points, 9.0F, 9.0F)[0], Label::dynamic);
    EXPECT_EQ(removert_of(points, 9.0F, 3.0F)[0], Label::static_);
    EXPECT_EQ(removert_of(points, 3.0F, 9.0F)[0], Label::static_);
    EXPECT_EQ(removert_of(points, kInf, kInf)[0], Label::static_);
}

TEST(Removert, OnlyTheNearestPointOfAPixelIsRemovedPerResolution) {
    const Point ray = Point(1.0F, 0.05F, 0.05F).normalized();
    const Points points{5.0F * ray, 3.0F * ray, 7.0F * ray};
    const Labels nearest{Label::static_, Label::dynamic, Label::static_};
    EXPECT_EQ(removert_of(points, 20.0F, 20.0F), nearest);
    // Another resolution removes the next one, but the coarse image again marks the nearest only.
    const std::array<KeyframeImages, 2> fine{{{everywhere(20.0F)}, {everywhere(20.0F)}}};
    EXPECT_EQ(removert(window_of(points), fine, {everywhere(20.0F)}, kMargin, kVoxel)[0], nearest);
}

TEST(Removert, AllPointsOfACellShareTheVerdict) {
    const Points points{{3.01F, 0.11F, 0.01F}, {3.02F, 0.12F, 0.02F}, {3.09F, 0.19F, 0.09F}};
    EXPECT_EQ(removert_of(points, 9.0F, 9.0F), Labels(3, Label::dynamic));
}

TEST(Removert, AtTheMarginExactlyAPointStays) {
    const std::array<KeyframeImages, 1> fine{{{everywhere(10.0F)}}};
    const KeyframeImages coarse{everywhere(50.0F)};
    const auto with = [&](float tau) {
        return removert(window_of({{8, 0, 0}}), fine, coarse, {tau, 0.125F}, kVoxel)[0][0];
    };
    EXPECT_EQ(with(1.0F), Label::static_);
    EXPECT_EQ(with(0.999F), Label::dynamic);
}

TEST(Removert, WhatWasNotMeasuredIsUnknown) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Points points{{0, 0, 0}, {nan, 1, 1}, {1, 1, 1}};
    EXPECT_EQ(removert_of(points, 50.0F, 50.0F),
              (Labels{Label::unknown, Label::unknown, Label::dynamic}));
}

TEST(Removert, NeverRemovesMoreThanTheFirstLookMarks) {
    test::Random random(2);
    const Window window = random_window(random);
    const std::array<KeyframeImages, 1> fine{{keyframe_images(window, 0.05F, 0.05F)}};
    const auto labels =
        removert(window, fine, keyframe_images(window, 0.2F, 0.2F), kMargin, kVoxel);
    const auto measured = remove_by_visibility(window, {}, {});
    const auto marked = marked_by_hand(window, measured, Label::static_, fine[0]);
    int dynamic = 0;
    for (std::size_t s = 0; s < 3; ++s) {
        Points points;
        to_map(window.scans[s], points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            ASSERT_EQ(labels[s][i] == Label::unknown, measured[s][i] == Label::unknown);
            if (labels[s][i] != Label::dynamic) continue;
            ++dynamic;
            ASSERT_TRUE(marked.at(pack(*cell_of(points[i], 2.0F / kVoxel))));
        }
    }
    EXPECT_GT(dynamic, 50);
}

}  // namespace removert_test
}  // namespace dynamic_filter
