// SPDX-License-Identifier: MIT
#include "tracking/upright.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// A rotating sensor of 16 beams in a hall of 30 m x 20 m, 1.5 m above the floor.
Points in_a_hall() {
    Points points;
    for (int beam = -15; beam <= 15; beam += 2) {
        const double elevation = beam * std::numbers::pi / 180.0;
        for (int i = 0; i < 360; ++i) {
            const double azimuth = i * std::numbers::pi / 180.0;
            const Eigen::Vector3d direction(std::cos(azimuth) * std::cos(elevation),
                                            std::sin(azimuth) * std::cos(elevation),
                                            std::sin(elevation));
            const double wall =
                std::min(15.0 / std::abs(direction.x()), 10.0 / std::abs(direction.y()));
            const double floor = beam < 0 ? -1.5 / direction.z() : 1e9;
            points.push_back((direction * std::min(wall, floor)).cast<float>());
        }
    }
    return points;
}

TEST(Upright, RotationTurnsTheVerticalOfAnyAxesIntoZ) {
    const Points hall = in_a_hall();
    EXPECT_EQ(upright_rotation(hall), Eigen::Matrix3d::Identity());
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
            if (axis == 2 && sign < 0.0) continue;  // a sensor that hangs upside down stays so
            const Eigen::Vector3d up = sign * Eigen::Vector3d::Unit(axis);
            const auto turned =
                Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), up).cast<float>();
            Points points;
            for (const Point& p : hall) points.push_back(turned * p);
            EXPECT_TRUE((upright_rotation(points) * up).isApprox(Eigen::Vector3d::UnitZ(), 1e-9))
                << up.transpose();
        }
    }
}

TEST(Upright, RotationOfNothingIsNone) {
    EXPECT_EQ(upright_rotation({}), Eigen::Matrix3d::Identity());
    EXPECT_EQ(upright_rotation({Point::Zero(), Point(1, 0, 0)}), Eigen::Matrix3d::Identity());
}

}  // namespace upright_test
}  // namespace dynamic_filter
