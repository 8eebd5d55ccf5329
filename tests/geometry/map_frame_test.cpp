// SPDX-License-Identifier: MIT
#include "geometry/map_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dynamic_filter {
namespace map_frame_test {

Scan scan_at(const Eigen::Vector3d& place) {
    Scan scan;
    scan.points = {{1.0F, 0.0F, 0.0F}, Point::Zero(), {0.0F, 2.0F, 0.0F}};
    scan.T_world_sensor.translation() = place;
    return scan;
}

TEST(MapFrame, NoPointHasAVoxelBeforeItBegins) {
    const MapFrame frame{.voxel_size = 0.2};
    const LocatedScan located = frame.locate(scan_at({0.0, 0.0, 0.0}), VoxelIndex());
    EXPECT_EQ(located.voxels, PointVoxels(3, kNoVoxel));
    EXPECT_EQ(located.in_map.keys, std::vector<VoxelKey>(3, kNoKey));
}

TEST(MapFrame, BeginsAWholeNumberOfVoxelsFromTheWorldAndOnce) {
    MapFrame frame{.voxel_size = 0.2};
    const Eigen::Vector3d far(5e5, 4e6, -13.0);
    frame.begin(scan_at(far).T_world_sensor);
    ASSERT_TRUE(frame.origin);
    const Eigen::Vector3d origin = *frame.origin;
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(origin[axis] / 0.2, std::round(origin[axis] / 0.2), 1e-4);
        EXPECT_NEAR(origin[axis], far[axis], 20.0);
    }
    frame.begin(Pose::Identity());
    EXPECT_EQ(*frame.origin, origin);
}

TEST(MapFrame, APointIsInTheVoxelWhoseCenterIsNear) {
    MapFrame frame{.voxel_size = 0.2};
    const Scan scan = scan_at({5e5, 4e6, -13.0});
    frame.begin(scan.T_world_sensor);
    VoxelIndex voxels;
    const LocatedScan before = frame.locate(scan, voxels);
    EXPECT_EQ(before.voxels[0], kNoVoxel);  // the map has none yet
    const std::uint32_t voxel = voxels.insert(before.in_map.keys[0]);
    const LocatedScan located = frame.locate(scan, voxels);
    EXPECT_EQ(located.voxels, (PointVoxels{voxel, kNoVoxel, kNoVoxel}));
    const Eigen::Vector3d world = scan.T_world_sensor * scan.points[0].cast<double>();
    EXPECT_LT((frame.center_of(voxels.key(voxel)) - world).cwiseAbs().maxCoeff(), 0.11);
}

}  // namespace map_frame_test
}  // namespace dynamic_filter
