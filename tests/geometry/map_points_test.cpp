// SPDX-License-Identifier: MIT
#include "dynamic_filter/geometry/map_points.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

#include "dynamic_filter/submaps_observe/submap.hpp"
#include "geometry/voxel_kernel.hpp"
#include "support/levels.hpp"
#include "support/random.hpp"

namespace dynamic_filter {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

Points points_of_all_kinds(std::size_t count) {
    test::Random random(11);
    Points points = {{0, 0, 0},     {kNan, 0, 0},       {0, -kInf, 0}, {1, 2, kNan},
                     {3e38F, 0, 0}, {1e9F, 0, 0},       {0, 0, -2e5F}, {1e-20F, 0, 0},
                     {-1e5F, 1, 1}, {0.2F, -0.2F, 0.4F}};
    while (points.size() < count) {
        const float reach = points.size() % 3 == 0 ? 2e5F : 50.0F;
        points.emplace_back(random.uniform_f(-reach, reach), random.uniform_f(-reach, reach),
                            random.uniform_f(-5.0F, 5.0F));
    }
    return points;
}

Pose somewhere() {
    Pose pose = Pose::Identity();
    pose.translation() = Eigen::Vector3d(3.7, -12.1, 0.9);
    pose.linear() =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.1, 0.2, 1.0).normalized()).toRotationMatrix();
    return pose;
}

TEST(ToVoxels, IsWhereThePointIsAndItsVoxel) {
    const Points points = points_of_all_kinds(5000);
    MapPoints out;
    to_voxels(points, somewhere(), 0.2F, out);
    ASSERT_EQ(out.points.size(), points.size());
    std::size_t none = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!is_measured(points[i])) {
            EXPECT_EQ(out.keys[i], kNoKey) << i;
            continue;
        }
        const Eigen::Vector3d exact = somewhere() * points[i].cast<double>();
        EXPECT_LE((out.points[i].cast<double>() - exact).norm(), 1e-6 * exact.norm() + 1e-5) << i;
        EXPECT_EQ(out.keys[i], voxel_of(out.points[i], 0.2F).value_or(kNoKey)) << i;
        none += out.keys[i] == kNoKey ? 1 : 0;
    }
    EXPECT_GT(none, 100U);  // too far out
    EXPECT_LT(none, 2000U);
}

TEST(ToVoxels, OfTheMapItsOriginIsAPoint) {
    const Points points = {{0, 0, 0}, {1, 2, 3}, {kNan, 0, 0}};
    MapPoints out;
    to_voxels(points, 0.2F, out);
    EXPECT_EQ(out.keys, (std::vector<VoxelKey>{*voxel_of(points[0], 0.2F),
                                               *voxel_of(points[1], 0.2F), kNoKey}));
    EXPECT_EQ(out.points[1], points[1]);
}

TEST(ToVoxels, NothingGivesNothing) {
    MapPoints out{Points(3), {1, 2, 3}};
    to_voxels({}, Pose::Identity(), 0.2F, out);
    EXPECT_TRUE(out.points.empty());
    EXPECT_TRUE(out.keys.empty());
}

TEST(VoxelKernel, EveryLevelAgreesBitByBit) {
    const Points points = points_of_all_kinds(1013);  // no whole number of vectors
    const Eigen::Matrix<float, 3, 4, Eigen::RowMajor> matrix =
        somewhere().matrix().topRows<3>().cast<float>();
    MapPoints expected;
    to_voxels(points, somewhere(), 0.1F, expected);
    for (const auto& level : DYNAMIC_FILTER_LEVELS_OF(to_voxels)) {
        MapPoints out{Points(points.size()), std::vector<VoxelKey>(points.size() + 1, 7)};
        level.run({.xyz = points.front().data(),
                   .count = points.size(),
                   .matrix = matrix.data(),
                   .half_cells_per_metre = 2.0F / 0.1F,
                   .map_xyz = out.points.front().data(),
                   .keys = out.keys.data()});
        EXPECT_EQ(out.keys.back(), 7U) << level.name;  // a guard
        out.keys.pop_back();
        EXPECT_EQ(out.keys, expected.keys) << level.name;
        EXPECT_EQ(
            std::memcmp(out.points.data(), expected.points.data(), points.size() * sizeof(Point)),
            0)
            << level.name;
    }
}

}  // namespace
}  // namespace dynamic_filter
