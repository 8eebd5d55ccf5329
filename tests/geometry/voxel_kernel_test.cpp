// SPDX-License-Identifier: MIT
#include "geometry/voxel_kernel.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "geometry/map_points.hpp"
#include "geometry/odd_points.hpp"
#include "support/levels.hpp"

namespace dynamic_filter {
namespace voxel_kernel_test {

TEST(VoxelKernel, EveryLevelAgreesBitByBit) {
    const Points points = test::points_of_all_kinds(1013);  // no whole number of vectors
    const Eigen::Matrix<float, 3, 4, Eigen::RowMajor> matrix =
        test::somewhere().matrix().topRows<3>().cast<float>();
    MapPoints expected;
    to_voxels(points, test::somewhere(), 0.1F, expected);
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

}  // namespace voxel_kernel_test
}  // namespace dynamic_filter
