// SPDX-License-Identifier: MIT
#include "dynamic_filter/poses.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace dynamic_filter::io {
namespace pose_fix_test {

TEST(PoseFix, EachHasAName) {
    std::set<std::string> names{to_string(PoseFix::none)};
    for (const PoseFix fix : pose_fixes()) names.insert(to_string(fix));
    EXPECT_EQ(names,
              (std::set<std::string>{"none", "inverse", "camera", "lidar", "wxyz", "xyzw", "mm",
                                     "cm", "feet", "transpose", "mirror", "ned", "relative"}));
}

TEST(PoseFix, EachUndoesItsMistake) {
    const Pose pose = Pose(Eigen::Translation3d(1, 2, 3)) *
                      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized());
    Pose millimetres = pose;
    millimetres.translation() *= 1000.0;
    EXPECT_TRUE(fixed(PoseFix::millimetres, millimetres).isApprox(pose, 1e-12));
    Pose centimetres = pose;
    centimetres.translation() *= 100.0;
    EXPECT_TRUE(fixed(PoseFix::centimetres, centimetres).isApprox(pose, 1e-12));
    Pose transposed = pose;
    transposed.linear().transposeInPlace();
    EXPECT_TRUE(fixed(PoseFix::transpose, transposed).isApprox(pose, 1e-12));
    EXPECT_TRUE(fixed(PoseFix::inverse, pose.inverse()).isApprox(pose, 1e-12));
    EXPECT_TRUE(fixed(PoseFix::camera, fixed(PoseFix::lidar, pose)).isApprox(pose, 1e-12));
    EXPECT_TRUE(fixed(PoseFix::wxyz, fixed(PoseFix::xyzw, pose)).isApprox(pose, 1e-12));
    EXPECT_TRUE(fixed(PoseFix::none, pose).isApprox(pose, 0.0));
}

TEST(PoseFix, MotionsAreChained) {
    const Pose step =
        Pose(Eigen::Translation3d(1, 0, 0)) * Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ());
    Pose lost = Pose::Identity();
    lost.translation().setConstant(std::nan(""));
    const std::vector<Pose> poses = chained({step, step, lost, step});
    EXPECT_TRUE(poses[0].isApprox(step));
    EXPECT_TRUE(poses[1].isApprox(step * step));
    EXPECT_FALSE(poses[2].matrix().allFinite());
    EXPECT_TRUE(poses[3].isApprox(step * step * step));
    EXPECT_TRUE(chained({}).empty());
    EXPECT_TRUE(fixed(PoseFix::relative, step).isApprox(step));
}

/// A turn to the left, after which the sensor moves ahead: in a left-handed frame y is to the
/// right, and so it is in a frame whose z axis points down.
TEST(PoseFix, ReversedAxes) {
    const auto left = Pose(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ())) *
                      Pose(Eigen::Translation3d(2, 0, 0.3));
    const auto reversed = [&](double z, double yaw) {
        return Pose(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())) *
               Pose(Eigen::Translation3d(2, 0, z));
    };
    EXPECT_TRUE(fixed(PoseFix::mirror, reversed(0.3, -0.5)).isApprox(left, 1e-12));
    EXPECT_TRUE(fixed(PoseFix::ned, reversed(-0.3, -0.5)).isApprox(left, 1e-12));
    for (const PoseFix fix : {PoseFix::mirror, PoseFix::ned}) {
        EXPECT_TRUE(fixed(fix, fixed(fix, left)).isApprox(left, 1e-12));
    }
}

/// Ahead, z for a camera, is x for a LiDAR.
TEST(PoseFix, ACameraLooksAhead) {
    const Pose ahead = fixed(PoseFix::camera, Pose(Eigen::Translation3d(0, 0, 1)));
    EXPECT_TRUE(ahead.translation().isApprox(Eigen::Vector3d::UnitX(), 1e-12));
}

}  // namespace pose_fix_test
}  // namespace dynamic_filter::io
