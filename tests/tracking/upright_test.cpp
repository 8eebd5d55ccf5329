// SPDX-License-Identifier: MIT
#include "tracking/upright.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace dynamic_filter {
namespace upright_test {

/// Poles of 2 m on a floor 1.5 m below the sensor.
Points poles_and_floor() {
    Points points;
    for (int x = -10; x <= 10; x += 4) {
        for (int y = -9; y <= 9; y += 6) {
            for (float z = -1.5F; z < 0.5F; z += 0.1F) {
                points.emplace_back(static_cast<float>(x) + 0.5F, static_cast<float>(y), z);
            }
        }
    }
    for (float x = -10.0F; x < 10.0F; x += 0.5F) points.emplace_back(x, 2.0F, -1.5F);
    return points;
}

TEST(Upright, LeavesOutTheGroundAndTheFeet) {
    const Points upright = upright_points(poles_and_floor());
    ASSERT_FALSE(upright.empty());
    EXPECT_TRUE(std::all_of(upright.begin(), upright.end(),
                            [](const Point& p) { return p.z() > -1.3F && p.norm() > 2.0F; }));
}

TEST(Upright, OverlaysWhollyAtTheTruePoseAndLessBesideIt) {
    const Points upright = upright_points(poles_and_floor());
    EXPECT_EQ(upright_overlay(upright, upright, Pose::Identity()), 1.0);
    EXPECT_EQ(upright_overlay(upright, upright, Pose(Eigen::Translation3d(1.0, 0.0, 0.0))), 0.0);
    EXPECT_EQ(upright_overlay({}, {}, Pose::Identity()), 0.0);
}

}  // namespace upright_test
}  // namespace dynamic_filter
