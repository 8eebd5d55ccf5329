// SPDX-License-Identifier: MIT
#include "tracking/pose_jump.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter {
namespace pose_jump_test {

StampedPose at(double x, double stamp) {
    StampedPose pose;
    pose.T_world_sensor.translation().x() = x;
    pose.stamp = stamp;
    return pose;
}

TEST(PoseJump, IsKnownFromTheThirdPoseOn) {
    EXPECT_FALSE(pose_jump({}, {}, at(100, 1)));
    EXPECT_FALSE(pose_jump({}, at(0, 0), at(100, 0.1)));
    EXPECT_TRUE(pose_jump(at(0, 0), at(0, 0.1), at(100, 0.2)));
}

TEST(PoseJump, FiveMetresBetweenScansIsOne) {
    for (const double speed : {0.0, 1.5, 20.0}) {
        const auto off = pose_jump(at(0, 0), at(0.1 * speed, 0.1), at(0.2 * speed + 5.0, 0.2));
        ASSERT_TRUE(off) << speed;
        EXPECT_NEAR(*off, 5.0, 1e-9);
    }
}

TEST(PoseJump, DrivingBrakingNoiseAndGapsAreNone) {
    EXPECT_FALSE(pose_jump(at(0, 0), at(5, 0.1), at(10, 0.2)));      // 180 km/h
    EXPECT_FALSE(pose_jump(at(0, 0), at(3, 0.1), at(5.2, 0.2)));     // hard braking
    EXPECT_FALSE(pose_jump(at(0, 0), at(0.3, 0.1), at(-0.3, 0.2)));  // 0.3 m of noise
    EXPECT_FALSE(pose_jump(at(0, 0), at(7.5, 0.5), at(30, 2.0)));    // a gap
    EXPECT_FALSE(pose_jump(at(0, 0), at(0, 0.1), at(40, 3.0)));      // stood, then drove off
    EXPECT_FALSE(pose_jump(at(0, 0), at(100, 0.0), at(0, 0.1)));     // equal stamps: unknown
}

TEST(PoseJump, DependsOnDifferencesOnly) {
    constexpr double kFar = 4000.0, kLate = 1.6e9;
    const auto off =
        pose_jump(at(kFar, kLate), at(kFar + 2.0, kLate + 0.125), at(kFar + 9.0, kLate + 0.25));
    ASSERT_TRUE(off);
    EXPECT_NEAR(*off, 5.0, 1e-6);
    EXPECT_FALSE(
        pose_jump(at(kFar, kLate), at(kFar + 2.0, kLate + 0.125), at(kFar + 4.0, kLate + 0.25)));
}

// With 50 m/s^2 over the last step and the one before: 2 m + 50 * 0.1 * (0.05 + 0.1) m.
TEST(PoseJump, AllowsForAnAccelerationSinceThePoseBeforeTheLast) {
    EXPECT_FALSE(pose_jump(at(0, 0), at(0, 0.1), at(2.7, 0.2)));
    EXPECT_TRUE(pose_jump(at(0, 0), at(0, 0.1), at(2.8, 0.2)));
}

TEST(PoseJump, TwoSensorsThatTakeTurnsAreNone) {
    EXPECT_FALSE(pose_jump(at(0.0, 0.0), at(0.5, 0.01), at(0.1, 0.1)));
    EXPECT_FALSE(pose_jump(at(0.5, 0.01), at(0.1, 0.1), at(0.6, 0.11)));
}

}  // namespace pose_jump_test
}  // namespace dynamic_filter
