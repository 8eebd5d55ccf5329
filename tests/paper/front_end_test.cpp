// SPDX-License-Identifier: MIT
#include "paper/front_end.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "geometry/pose.hpp"
#include "paper/removert.hpp"
#include "paper/reverting.hpp"
#include "paper/visibility_removal.hpp"
#include "support/room.hpp"

namespace dynamic_filter {
namespace front_end_test {

constexpr double kDeg = std::numbers::pi / 180.0;

Window room_window() {
    Window window;
    for (const auto& s : test::drive(10, true)) {
        if (window.scans.size() % 2 == 0) window.keyframes.push_back(window.scans.size());
        window.scans.push_back(s.scan);
    }
    window.scans[1].points[0] = Point::Zero();
    return window;
}

FrontEndResult process(const Config& config) {
    FrontEnd front_end(config);
    StageTimes times;
    return front_end.process(room_window(), times);
}

std::size_t count(const std::vector<Labels>& labels, Label wanted) {
    std::size_t sum = 0;
    for (const Labels& scan : labels) {
        sum += static_cast<std::size_t>(std::count(scan.begin(), scan.end(), wanted));
    }
    return sum;
}

std::set<VoxelKey> still_voxels(const Window& window, const std::vector<Labels>& labels,
                                float size) {
    std::set<VoxelKey> keys;
    for (std::size_t s = 0; s < window.scans.size(); ++s) {
        Points points;
        to_map(window.scans[s], points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (labels[s][i] == Label::static_) keys.insert(*voxel_of(points[i], size));
        }
    }
    return keys;
}

TEST(PixelStep, IsTheLargerOfTheLeastStepAndTheBeams) {
    EXPECT_FLOAT_EQ(pixel_step(1.0, 1.0, 0.0F), static_cast<float>(kDeg));
    EXPECT_FLOAT_EQ(pixel_step(1.0, 1.5, 0.04F), 0.06F);
    EXPECT_FLOAT_EQ(pixel_step(2.0, 0.0, 0.04F), static_cast<float>(2.0 * kDeg));
}

TEST(FrontEnd, LabelsEveryPointAndCollectsTheStillOnes) {
    const Window window = room_window();
    for (const auto reverting : {Reverting::map, Reverting::visibility, Reverting::none}) {
        Config config;
        config.front_end.reverting = reverting;
        const FrontEndResult result = process(config);
        ASSERT_EQ(result.labels.size(), window.scans.size());
        for (std::size_t s = 0; s < window.scans.size(); ++s) {
            EXPECT_EQ(result.labels[s].size(), window.scans[s].points.size());
        }
        EXPECT_EQ(count(result.labels, Label::unknown), 1U);
        const auto size = static_cast<float>(config.map.voxel_size);
        std::set<VoxelKey> owned;
        for (const Point& p : result.submap.points) owned.insert(*voxel_of(p, size));
        EXPECT_EQ(owned, still_voxels(window, result.labels, size));
    }
}

TEST(FrontEnd, TheSubmapHasTheMeanPoseOfItsScans) {
    std::vector<Pose> poses;
    for (const Scan& s : room_window().scans) poses.push_back(s.T_world_sensor);
    EXPECT_TRUE(process({}).submap.T_map_submap.isApprox(mean_pose(poses), 1e-12));
}

TEST(FrontEnd, SwitchedOffEveryMeasuredPointIsStill) {
    Config config;
    config.front_end.enabled = false;
    const auto labels = process(config).labels;
    EXPECT_EQ(count(labels, Label::dynamic), 0U);
    EXPECT_EQ(count(labels, Label::unknown), 1U);
}

TEST(FrontEnd, RevertsByTheChosenRule) {
    const Window window = room_window();
    Config config;
    config.front_end.image_step_deg = 4.0;  // above the beams' spacing
    config.front_end.image_step_beams = 0.0;
    config.front_end.revert_image_scale = 4.0;
    const RemovalMargin margin{static_cast<float>(config.front_end.tau),
                               static_cast<float>(config.front_end.tau_per_metre)};
    const auto step = static_cast<float>(4.0 * kDeg);
    const auto images = [&](float scale) {
        return keyframe_images(window, scale * step, scale * step);
    };
    config.front_end.reverting = Reverting::none;
    const auto removed = process(config).labels;
    EXPECT_GT(count(removed, Label::dynamic), 100U);

    config.front_end.reverting = Reverting::visibility;
    auto expected = removed;
    revert_by_visibility(window, images(4.0F), margin, static_cast<float>(config.map.voxel_size),
                         expected);
    EXPECT_EQ(process(config).labels, expected);

    config.front_end.reverting = Reverting::map;
    expected = removed;
    Thinner thinner(static_cast<float>(config.map.voxel_size));
    for (std::size_t s = 0; s < window.scans.size(); ++s) {
        Points points;
        to_map(window.scans[s], points);
        thinner.add(points, removed[s], Label::static_);
    }
    const NeighborGrid grid(thinner.points(), static_cast<float>(config.front_end.revert_radius));
    revert_by_map(window, grid, config.front_end, expected);
    EXPECT_EQ(process(config).labels, expected);
}

TEST(FrontEnd, RemovertHasItsOwnReverting) {
    Config config;
    config.method = Method::removert;
    const auto labels = process(config).labels;
    EXPECT_GT(count(labels, Label::dynamic), 0U);
    EXPECT_GT(count(labels, Label::static_), count(labels, Label::dynamic));
    EXPECT_EQ(count(labels, Label::unknown), 1U);
    config.front_end.reverting = Reverting::none;
    EXPECT_EQ(process(config).labels, labels);
}

TEST(FrontEnd, ReadsTheBeamsOffTheFirstWindowOnly) {
    FrontEnd front_end{Config{}};
    StageTimes times;
    EXPECT_FALSE(front_end.beams());
    front_end.process(room_window(), times);
    ASSERT_TRUE(front_end.beams());
    EXPECT_NEAR(front_end.beams()->azimuth_spacing, 1.5 * kDeg, 0.15 * kDeg);
    EXPECT_NEAR(front_end.beams()->elevation_spacing, 50.0 / 15.0 * kDeg, 0.3 * kDeg);
    Window other;
    other.scans.push_back(test::drive(1, false)[0].scan);
    other.scans[0].points.resize(100);
    other.keyframes = {0};
    const float before = front_end.beams()->azimuth_spacing;
    front_end.process(other, times);
    EXPECT_EQ(front_end.beams()->azimuth_spacing, before);
    EXPECT_EQ(times.at("submap").count(), 2U);
}

TEST(FrontEnd, AWindowOfOneScanIsAllStill) {
    FrontEnd front_end{Config{}};
    StageTimes times;
    Window window;
    window.scans.push_back(test::drive(1, true)[0].scan);
    window.keyframes = {0};
    const auto result = front_end.process(window, times);
    EXPECT_EQ(count(result.labels, Label::static_), window.scans[0].points.size());
}

}  // namespace front_end_test
}  // namespace dynamic_filter
