// SPDX-License-Identifier: MIT
#include "geometry/map_points.hpp"

#include <gtest/gtest.h>

#include "geometry/odd_points.hpp"
#include "paper/submap.hpp"

namespace dynamic_filter {
namespace map_points_test {

using test::kNan;
using test::points_of_all_kinds;
using test::somewhere;

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

}  // namespace map_points_test
}  // namespace dynamic_filter
