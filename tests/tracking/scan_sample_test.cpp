// SPDX-License-Identifier: MIT
#include "tracking/scan_sample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "geometry/voxel.hpp"
#include "support/random.hpp"

namespace dynamic_filter {
namespace scan_sample_test {

std::vector<float> times_of(const Points& points) {
    std::vector<float> times(points.size());
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<float>(i) * 1e-6F;
    return times;
}

void expect_part_of(const ScanSample& sample, const Points& points,
                    const std::vector<float>& times) {
    ASSERT_EQ(sample.points.size(), sample.chosen.size());
    ASSERT_EQ(sample.times.size(), sample.chosen.size());
    EXPECT_TRUE(std::is_sorted(sample.chosen.begin(), sample.chosen.end()));
    for (std::size_t i = 0; i < sample.chosen.size(); ++i) {
        EXPECT_EQ(sample.points[i], points[sample.chosen[i]]);
        EXPECT_EQ(sample.times[i], times[sample.chosen[i]]);
    }
}

std::set<VoxelKey> voxels_of(const Points& points, double size) {
    std::set<VoxelKey> keys;
    for (const Point& p : points) keys.insert(pack(*cell_of(p, static_cast<float>(1.0 / size))));
    return keys;
}

TEST(ScanSample, HasOnePointInEachVoxelInRange) {
    test::Random random(1);
    OdometryConfig config;
    config.nearest = 2.0;
    config.farthest = 9.0;
    const Points points = random.points(50000, 8.0);
    const auto times = times_of(points);
    const ScanSample sample = sample_for_map(points, times, config);
    expect_part_of(sample, points, times);
    Points in_range;
    for (const Point& p : points) {
        if (p.norm() >= 2.0F && p.norm() <= 9.0F) in_range.push_back(p);
    }
    const auto expected = voxels_of(in_range, 0.4 * config.voxel);
    EXPECT_EQ(voxels_of(sample.points, 0.4 * config.voxel), expected);
    EXPECT_EQ(sample.points.size(), expected.size());

    config.points = 1 << 20;
    const ScanSample all = sample_for_registration(sample, config);
    expect_part_of(all, points, times);
    EXPECT_EQ(all.points.size(), voxels_of(sample.points, config.spacing).size());
    config.points = 500;
    const ScanSample some = sample_for_registration(sample, config);
    expect_part_of(some, points, times);
    EXPECT_EQ(some.points.size(), 500U);
    EXPECT_GT(some.chosen.back(), points.size() / 2);  // from all over the scan
}

TEST(ScanSample, OfLargeScansEveryFewPoints) {
    test::Random random(2);
    const Points points = random.points(200000, 80.0);
    const ScanSample sample = sample_for_map(points, {}, {});
    EXPECT_LE(sample.points.size(), 60000U);
    EXPECT_GT(sample.points.size(), 30000U);
    EXPECT_TRUE(sample.times.empty());
    EXPECT_GT(sample.chosen.back(), 199000U);
}

TEST(ScanSample, WhatIsNotMeasuredIsLeftOut) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInf = std::numeric_limits<float>::infinity();
    OdometryConfig config;
    config.nearest = 0.0;
    const Points points = {{kNan, 5, 5}, {5, kInf, 5}, Point::Zero(), {5, 5, 5}};
    EXPECT_EQ(sample_for_map(points, {}, config).chosen, std::vector<std::uint32_t>{3});
    EXPECT_TRUE(sample_for_map({}, {}, config).points.empty());
}

TEST(ScanSample, WhatIsDynamicCanBeLeftOut) {
    const Points points = {{5, 0, 0}, {6, 0, 0}, {7, 0, 0}, {0.1F, 0, 0}, {8, 0, 0}};
    const ScanSample sample = sample_for_map(points, {}, {});
    const Labels labels = {Label::static_, Label::dynamic, Label::unknown, Label::dynamic,
                           Label::dynamic};
    EXPECT_EQ(without_dynamic(sample, labels).chosen, (std::vector<std::uint32_t>{0, 2}));
    EXPECT_EQ(without_dynamic(sample, {}).chosen, (std::vector<std::uint32_t>{0, 1, 2, 4}));
}

TEST(ScanSample, MotionIsUndoneWhereTimesAreKnown) {
    Twist velocity = Twist::Zero();
    velocity.x() = 10.0;
    const Points points = {{5, 0, 0}};
    EXPECT_EQ(sample_for_map(points, {}, {}).at_stamp(velocity), points);
    const auto sample = sample_for_map(points, std::vector<float>{0.1F}, {});
    EXPECT_NEAR(sample.at_stamp(velocity)[0].x(), 6.0F, 1e-4F);
}

}  // namespace scan_sample_test
}  // namespace dynamic_filter
