// SPDX-License-Identifier: MIT
#include "check/pose_outliers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace dynamic_filter::io {
namespace pose_outliers_test {

struct Path {
    std::vector<Pose> poses;
    std::vector<double> stamps;
};

/// At 10 Hz; brakes from 16 m/s by 8 m/s^2 until it rests.
Path braking() {
    Path path;
    for (int i = 0; i < 50; ++i) {
        const double t = 0.1 * i, braked = std::min(t, 2.0);
        path.poses.emplace_back(
            Eigen::Translation3d(16.0 * braked - 4.0 * braked * braked, 0.0, 0.0));
        path.stamps.push_back(t);
    }
    return path;
}

TEST(PoseOutliers, BrakingIsNone) {
    const Path path = braking();
    EXPECT_TRUE(outliers_of(path.poses, path.stamps).empty());
    EXPECT_TRUE(outliers_of({}, {}).empty());
}

TEST(PoseOutliers, SinglePosesApartAreNamed) {
    Path path = braking();
    path.poses[10].translation().y() += 3.0;
    path.poses[30].translation().z() -= 0.9;
    path.poses[40].translation().x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(outliers_of(path.poses, path.stamps), (std::vector<std::size_t>{10, 30}));
}

TEST(PoseOutliers, AJumpAfterWhichTheTrajectoryGoesOnIsNone) {
    Path path = braking();
    for (std::size_t i = 25; i < path.poses.size(); ++i) path.poses[i].translation().y() += 1.0;
    EXPECT_TRUE(outliers_of(path.poses, path.stamps).empty());
}

}  // namespace pose_outliers_test
}  // namespace dynamic_filter::io
