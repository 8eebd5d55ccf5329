// SPDX-License-Identifier: MIT
#include "paper/back_end.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "paper/submap.hpp"
#include "support/random.hpp"

namespace dynamic_filter {
namespace back_end_test {

constexpr BeamPattern kBeams{0.01F, 0.03F};

Config small_config() {
    Config config;
    config.map.voxel_size = 0.2;
    config.map.search_radius = 5.0;
    config.back_end.max_submaps = 3;
    return config;
}

Submap submap_at(double x, Points points) {
    Submap submap;
    submap.T_map_submap.translation().x() = x;
    submap.points = std::move(points);
    return submap;
}

Pose pose_at(double x) { return submap_at(x, {}).T_map_submap; }

std::set<VoxelKey> keys_of(const Points& points) {
    std::set<VoxelKey> keys;
    for (const Point& p : points) keys.insert(*voxel_of(p, 0.2F));
    return keys;
}

std::set<VoxelKey> keys_of(const LocalMap& local, const BackEnd& back_end) {
    std::set<VoxelKey> keys;
    for (const auto id : local.voxels) EXPECT_TRUE(keys.insert(back_end.voxels().key(id)).second);
    return keys;
}

TEST(BackEnd, NumbersTheVoxelsOfEverySubmap) {
    test::Random random(1);
    BackEnd back_end(small_config());
    StageTimes times;
    std::set<VoxelKey> all;
    for (int s = 0; s < 3; ++s) {
        const Points points = random.points(500, 2.0);
        back_end.insert(submap_at(s, points), kBeams, times);
        const BufferedSubmap& b = back_end.buffer().back();
        EXPECT_EQ(b.submap.points, points);
        EXPECT_EQ(b.normals.size(), points.size());
        EXPECT_TRUE(std::is_sorted(b.voxels.begin(), b.voxels.end()));
        std::set<VoxelKey> own;
        for (const auto id : b.voxels) EXPECT_TRUE(own.insert(back_end.voxels().key(id)).second);
        EXPECT_EQ(own, keys_of(points));
        all.insert(own.begin(), own.end());
    }
    EXPECT_EQ(back_end.voxels().size(), all.size());
    EXPECT_EQ(back_end.buffer().size(), 3U);
}

TEST(BackEnd, TheLocalMapHoldsTheVoxelsOfTheNearbySubmaps) {
    test::Random random(2);
    BackEnd back_end(small_config());
    StageTimes times;
    std::vector<Points> points;
    for (const double x : {0.0, 1.0, 2.0, 4.0, 20.0}) {
        points.push_back(random.points(200, 3.0));
        back_end.insert(submap_at(x, points.back()), kBeams, times);
    }
    const auto expect_union = [&](double x, const std::vector<std::size_t>& submaps) {
        std::set<VoxelKey> expected;
        for (const std::size_t s : submaps) expected.merge(keys_of(points[s]));
        const LocalMap local = back_end.local_map(pose_at(x), times);
        EXPECT_EQ(keys_of(local, back_end), expected);
        ASSERT_EQ(local.probability.size(), local.voxels.size());
        for (const float p : local.probability) EXPECT_TRUE(p > 0.0F && p <= 1.0F);
    };
    expect_union(-0.5, {0, 1, 2});  // the fourth is in reach, but three are the most
    expect_union(3.9, {3, 2, 1});
    expect_union(20.0, {4});
    expect_union(60.0, {});
}

TEST(BackEnd, ASubmapAloneIsAllOccupied) {
    test::Random random(3);
    BackEnd back_end(small_config());
    StageTimes times;
    back_end.insert(submap_at(0, random.points(300, 4.0)), kBeams, times);
    for (const float p : back_end.local_map(pose_at(0), times).probability) EXPECT_EQ(p, 1.0F);
}

TEST(BackEnd, AWallBehindProvesTheSpaceBeforeItFree) {
    Points wall, thing;
    for (int y = -20; y <= 20; ++y) {
        for (int z = -20; z <= 20; ++z) {
            wall.emplace_back(4.05F, 0.1F * static_cast<float>(y), 0.1F * static_cast<float>(z));
        }
    }
    for (int z = -5; z <= 5; ++z) thing.emplace_back(2.05F, 0.05F, 0.1F * static_cast<float>(z));
    Points both = wall;
    both.insert(both.end(), thing.begin(), thing.end());
    BackEnd back_end(small_config());
    StageTimes times;
    back_end.insert(submap_at(0, both), kBeams, times);
    back_end.insert(submap_at(0, wall), kBeams, times);
    const LocalMap local = back_end.local_map(pose_at(0), times);
    for (std::size_t i = 0; i < local.voxels.size(); ++i) {
        const bool free = center(back_end.voxels().key(local.voxels[i]), 0.2F).x() < 3.0F;
        EXPECT_EQ(local.probability[i], free ? 0.5F : 1.0F);
    }
}

TEST(BackEnd, AQueryBeforeAnySubmapIsEmpty) {
    BackEnd back_end(small_config());
    StageTimes times;
    EXPECT_TRUE(back_end.local_map(pose_at(0), times).voxels.empty());
}

TEST(BackEnd, AnEmptySubmapOwnsNothing) {
    BackEnd back_end(small_config());
    StageTimes times;
    back_end.insert(submap_at(0, {}), {}, times);
    EXPECT_TRUE(back_end.buffer()[0].voxels.empty());
    EXPECT_TRUE(back_end.local_map(pose_at(0), times).voxels.empty());
}

TEST(BackEnd, PointsBeyondTheKeysOwnNoVoxel) {
    BackEnd back_end(small_config());
    StageTimes times;
    back_end.insert(submap_at(0, {{1e9F, 0, 0}, {1, 1, 1}}), kBeams, times);
    EXPECT_EQ(back_end.buffer()[0].voxels.size(), 1U);
}

std::vector<double> positions(const BackEnd& back_end) {
    std::vector<double> xs;
    for (const auto& b : back_end.buffer()) xs.push_back(b.submap.T_map_submap.translation().x());
    return xs;
}

/// Submaps of 100 points each at the given places.
BackEnd with_submaps_at(const std::vector<double>& xs) {
    test::Random random(5);
    BackEnd back_end(small_config());
    StageTimes times;
    for (const double x : xs) {
        back_end.insert(submap_at(x, random.points(100, 3.0)), kBeams, times);
    }
    return back_end;
}

TEST(BackEnd, ForgetsTheSubmapsBeyondTheRadius) {
    BackEnd back_end = with_submaps_at({0.0, 40.0, 20.0, 60.0});
    EXPECT_EQ(back_end.keep_within({50.0, 0.0, 0.0}, 12.0, 1000), 12.0);
    EXPECT_EQ(positions(back_end), (std::vector<double>{40.0, 60.0}));
    std::set<VoxelKey> kept;
    for (const auto& b : back_end.buffer()) {
        std::set<VoxelKey> own;
        for (const auto id : b.voxels) own.insert(back_end.voxels().key(id));
        EXPECT_EQ(own, keys_of(b.submap.points));
        kept.merge(own);
    }
    EXPECT_EQ(back_end.voxels().size(), kept.size());  // the voxels are numbered anew
}

TEST(BackEnd, ForgetsTheFarthestSubmapsWhileItHoldsTooManyPoints) {
    BackEnd back_end = with_submaps_at({0.0, 5.0, 10.0, 15.0});
    EXPECT_EQ(back_end.keep_within({14.0, 0.0, 0.0}, 100.0, 400), 100.0);  // exactly as many
    EXPECT_EQ(positions(back_end).size(), 4U);
    EXPECT_EQ(back_end.keep_within({14.0, 0.0, 0.0}, 100.0, 299), 9.0);  // the last one forgotten
    EXPECT_EQ(positions(back_end), (std::vector<double>{10.0, 15.0}));
}

TEST(BackEnd, KeepsTheNearestSubmapHoweverManyPointsItHas) {
    BackEnd back_end = with_submaps_at({0.0, 5.0});
    back_end.keep_within({4.0, 0.0, 0.0}, 100.0, 1);
    EXPECT_EQ(positions(back_end), (std::vector<double>{5.0}));
}

TEST(BackEnd, TheLatestLocalMapIsAnchoredAtTheNewestSubmap) {
    BackEnd back_end = with_submaps_at({0.0, 2.0, 4.0});
    StageTimes times;
    const LocalMap latest = back_end.local_map(pose_at(4.0), times);
    const LocalMap third = back_end.local_map_of(2, times);
    EXPECT_EQ(latest.voxels, third.voxels);
    EXPECT_EQ(latest.probability, third.probability);
    EXPECT_FALSE(latest.voxels.empty());
}

TEST(BackEnd, WithoutIncidentCorrectionItNeedsNoNormals) {
    test::Random random(4);
    Config config = small_config();
    config.back_end.incident_correction = false;
    BackEnd back_end(config);
    StageTimes times;
    back_end.insert(submap_at(0, random.points(300, 4.0)), kBeams, times);
    EXPECT_EQ(times.count("normals"), 0U);
    EXPECT_FALSE(back_end.local_map(pose_at(0), times).voxels.empty());
}

}  // namespace back_end_test
}  // namespace dynamic_filter
