// SPDX-License-Identifier: MIT
#include "paper/submaps_method.hpp"

#include <gtest/gtest.h>

#include <map>

#include "support/outcome.hpp"

namespace dynamic_filter {
namespace submaps_method_test {

using test::drive;
using test::RoomScan;
using test::small_windows;

/// Returns how many instant verdicts each scan gave.
std::vector<std::size_t> judge_all(SubmapsMethod& method, const std::vector<RoomScan>& scans) {
    std::vector<std::size_t> verdicts;
    for (const RoomScan& s : scans) {
        Judged judged = method.judge(s.scan);
        if (judged.integrate) judged.integrate();
        verdicts.push_back(judged.verdicts.size());
    }
    return verdicts;
}

/// The verdict on points in the map frame; labels start unknown, and probabilities at -1.
Verdict decide(const SubmapsMethod& method, const Points& points) {
    LocatedScan located;
    to_voxels(points, Pose::Identity(), static_cast<float>(small_windows().map.voxel_size),
              located.in_map);
    for (const VoxelKey key : located.in_map.keys) {
        located.voxels.push_back(method.voxels().find(key).value_or(kNoVoxel));
    }
    Verdict verdict{0, Labels(points.size(), Label::unknown),
                    std::vector<float>(points.size(), -1.0F)};
    method.decide(located, verdict);
    return verdict;
}

std::map<std::uint32_t, float> as_map(const std::vector<VoxelOccupancy>& voxels) {
    std::map<std::uint32_t, float> map;
    for (const VoxelOccupancy& v : voxels) map[v.voxel] = v.probability;
    EXPECT_EQ(map.size(), voxels.size());
    return map;
}

const Point kAir(0.5F, 0.25F, 1.25F), kFarAir(300.0F, 0.0F, 1.0F);

TEST(SubmapsMethod, JudgesWindowByWindow) {
    SubmapsMethod method(small_windows());
    EXPECT_FALSE(method.judges_each_scan());
    const auto verdicts = judge_all(method, drive(20, true));
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
        EXPECT_EQ(verdicts[i], i == 8 || i == 16 ? 8U : 0U) << i;
    }
    const auto rest = method.finish();
    ASSERT_EQ(rest.size(), 4U);
    EXPECT_EQ(rest.front().index, 16U);
    EXPECT_EQ(rest.back().index, 19U);
    const MapContents contents = method.contents();
    EXPECT_EQ(contents.observer, "submaps");
    EXPECT_EQ(contents.observers, 3U);
    EXPECT_TRUE(contents.beams);
    ASSERT_EQ(contents.throughput.size(), 2U);
    for (const char* stage : {"front_end", "back_end", "merging"}) {
        EXPECT_TRUE(method.times().contains(stage)) << stage;
    }
}

TEST(SubmapsMethod, RemovertIsOneWindowWithoutBackEnd) {
    Config config = small_windows();
    config.method = Method::removert;
    SubmapsMethod method(config);
    for (const std::size_t verdicts : judge_all(method, drive(20, true))) EXPECT_EQ(verdicts, 0U);
    EXPECT_EQ(method.finish().size(), 20U);
    EXPECT_EQ(method.contents().observers, 1U);
    const auto map = as_map(method.static_map());
    EXPECT_EQ(map.size(), method.voxels().size());
    for (const auto& [voxel, probability] : map) EXPECT_EQ(probability, 1.0F);
}

TEST(SubmapsMethod, WhatNoStaticSubmapHoldsWasRemoved) {
    SubmapsMethod method(small_windows());
    judge_all(method, drive(16, true));
    method.finish();
    const Point nan = Point::Constant(std::numeric_limits<float>::quiet_NaN());
    const Verdict verdict = decide(method, {kAir, kFarAir, nan});
    EXPECT_EQ(verdict.labels, (Labels{Label::dynamic, Label::dynamic, Label::unknown}));
    EXPECT_EQ(verdict.probability, (std::vector<float>{0.0F, 0.0F, -1.0F}));
    Verdict untouched = verdict;
    method.settle({}, untouched);  // there are no verdicts before the end
    EXPECT_EQ(untouched.labels, verdict.labels);
}

TEST(SubmapsMethod, WhatWasForgottenIsUnknown) {
    SubmapsMethod method(small_windows());
    judge_all(method, drive(16, true));
    const std::size_t before = method.size();
    method.keep_within(Eigen::Vector3d::Zero(), 20.0, SIZE_MAX);
    EXPECT_LE(method.size(), before);
    method.finish();
    const Verdict verdict = decide(method, {kAir, kFarAir});
    EXPECT_EQ(verdict.labels, (Labels{Label::dynamic, Label::unknown}));
    EXPECT_EQ(verdict.probability[1], 0.0F);
}

TEST(SubmapsMethod, MapsHoldTheVoxelsThatReachTheThreshold) {
    Config config = small_windows();
    SubmapsMethod method(config);
    judge_all(method, drive(16, true));
    method.finish();
    const auto map = as_map(method.static_map());
    ASSERT_GT(map.size(), 1000U);
    std::vector<std::uint32_t> all(method.voxels().size());
    for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
    const auto histories = method.histories(all);
    const auto threshold = static_cast<float>(config.map.occupancy_threshold);
    for (const std::uint32_t v : all) {
        const auto& probability = histories[v].probability;
        const bool is_static = probability && *probability >= threshold;
        ASSERT_EQ(map.contains(v), is_static);
        if (is_static) {
            EXPECT_EQ(map.at(v), *probability);
        }
        const Point middle =
            center(method.voxels().key(v), static_cast<float>(config.map.voxel_size));
        const Verdict verdict = decide(method, {middle});
        EXPECT_EQ(verdict.labels[0], label_of(probability, config.map.occupancy_threshold));
        EXPECT_EQ(verdict.probability[0], probability.value_or(0.0F));
    }
    const auto near = method.local_map(Pose::Identity(), std::nullopt);
    EXPECT_GT(near.size(), 1000U);
    for (const VoxelOccupancy& v : near) EXPECT_GE(v.probability, threshold);
    Pose far = Pose::Identity();
    far.translation().x() = 1e4;
    EXPECT_TRUE(method.local_map(far, std::nullopt).empty());
}

}  // namespace submaps_method_test
}  // namespace dynamic_filter
