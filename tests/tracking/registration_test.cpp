// SPDX-License-Identifier: MIT
#include "tracking/registration.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/planes.hpp"

namespace dynamic_filter {
namespace registration_test {

constexpr double kDegree = std::numbers::pi / 180.0;

SurfaceMap map_of(const std::vector<test::Rectangle>& rectangles, double noise,
                  test::Random& random) {
    SurfaceMap map(0.5);
    map.insert(test::points_on(rectangles, 60.0, noise, random));
    return map;
}

/// What a sensor at `pose` measures of them.
Points seen_from(const Pose& pose, const std::vector<test::Rectangle>& rectangles, double noise,
                 test::Random& random) {
    return moved(test::points_on(rectangles, 2.0, noise, random), pose.inverse());
}

Twist off(const Pose& found, const Pose& truth) { return log(truth.inverse() * found); }

TEST(Registration, RecoversADisplacement) {
    test::Random random(1);
    const SurfaceMap map = map_of(test::hall(), 0.0, random);
    for (int i = 0; i < 10; ++i) {
        const Pose truth = random.pose(0.5, 3.0 * kDegree);
        const Points points = seen_from(truth, test::hall(), 0.0, random);
        const Registration found = register_points(map, points, Pose::Identity(), {}, 2.0);
        EXPECT_LT(off(found.T_map_sensor, truth).head<3>().norm(), 1e-3);
        EXPECT_LT(off(found.T_map_sensor, truth).tail<3>().norm(), 0.01 * kDegree);
        EXPECT_GT(found.inliers, 0.95);
        EXPECT_GT(found.mapped, 0.95);
        EXPECT_TRUE((found.T_map_sensor.linear() * found.T_map_sensor.linear().transpose())
                        .isIdentity(1e-12));
    }
}

TEST(Registration, WhatTwoFifthsOfThePointsSayOtherwiseDoesNotCount) {
    test::Random random(2);
    const SurfaceMap map = map_of(test::hall(), 0.02, random);
    for (int i = 0; i < 10; ++i) {
        const Pose truth = random.pose(0.3, 2.0 * kDegree);
        Points points = seen_from(truth, test::hall(), 0.02, random);
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (k % 5 < 2) points[k] = random.point(9.0);
        }
        const Registration found = register_points(map, points, Pose::Identity(), {}, 1.0);
        EXPECT_LT(off(found.T_map_sensor, truth).head<3>().norm(), 5e-3);
        EXPECT_LT(off(found.T_map_sensor, truth).tail<3>().norm(), 0.05 * kDegree);
        EXPECT_LT(found.inliers, 0.75);
    }
}

struct InCorridor {
    PosePrior prior;
    Pose truth;
    Registration found;
};

/// A prior that is 0.3 m off along the corridor.
InCorridor register_in_corridor(double noise) {
    test::Random random(3);
    const auto walls = test::corridor();
    const SurfaceMap map = map_of(walls, noise, random);
    InCorridor out;
    out.prior.T_map_sensor.translation() = Eigen::Vector3d(0.7, 0.05, 0.02);
    out.prior.information.diagonal() << 400, 400, 400, 400, 400, 400;
    out.truth = Eigen::Translation3d(1.0, 0.1, -0.05) *
                Eigen::AngleAxisd(kDegree, Eigen::Vector3d::UnitZ());
    Points points = seen_from(out.truth, walls, noise, random);
    std::erase_if(points, [](const Point& p) { return p.norm() > 40.0F; });
    out.found = register_points(map, points, out.prior.T_map_sensor, out.prior, 0.5);
    return out;
}

TEST(Registration, AlongACorridorThePriorDecides) {
    for (const double noise : {0.0, 0.01}) {
        const auto [prior, truth, found] = register_in_corridor(noise);
        const Eigen::Vector3d at = found.T_map_sensor.translation();
        // planes in voxels where wall and floor meet are tilted at random: that says a little
        EXPECT_NEAR(at.x(), 0.7, 0.1);
        EXPECT_NEAR(at.y(), 0.1, 3e-3);
        EXPECT_NEAR(at.z(), -0.05, 3e-3);
        EXPECT_LT(off(found.T_map_sensor, truth).tail<3>().norm(), 0.05 * kDegree);
        EXPECT_LT(found.information(0, 0), 1e-3 * found.information(1, 1));
    }
}

TEST(Registration, ASurePriorIsKept) {
    test::Random random(4);
    const SurfaceMap map = map_of(test::hall(), 0.01, random);
    PosePrior prior{random.pose(0.2, kDegree), Information::Identity() * 1e12};
    const Points points = seen_from(Pose::Identity(), test::hall(), 0.01, random);
    const Registration found = register_points(map, points, Pose::Identity(), prior, 0.5);
    EXPECT_LT(off(found.T_map_sensor, prior.T_map_sensor).norm(), 1e-4);
}

/// A single ring on a hedge or on a facade with windows: its points lie on the cone of its beams,
/// wherever the sensor is.
TEST(Registration, PlanesThatContainTheBeamsDoNotHoldTheSensor) {
    test::Random random(5);
    const auto ring = [&](double height, double noise) {
        const auto z = static_cast<float>(height);
        return test::points_on({{{-20, -20, z}, {40, 0, 0}, {0, 40, 0}}}, 30.0, noise, random);
    };
    const auto registered = [&](double height) {
        SurfaceMap map(0.5);
        map.insert(ring(height, 0.01));
        return register_points(map, ring(height - 0.1, 0.01), Pose::Identity(), {}, 0.2);
    };
    const Registration on_ground = registered(-1.5);
    EXPECT_NEAR(on_ground.T_map_sensor.translation().z(), 0.1, 0.005);
    EXPECT_LT(registered(0.05).information(2, 2), 0.05 * on_ground.information(2, 2));
}

TEST(Registration, WithoutPointsOrAMapNothingIsKnown) {
    test::Random random(5);
    const SurfaceMap map = map_of(test::hall(), 0.01, random);
    const Pose start = random.pose(3.0, 1.0);
    const Registration none = register_points(map, {}, start, {}, 0.5);
    EXPECT_EQ(none.T_map_sensor.matrix(), start.matrix());
    EXPECT_EQ(none.inliers, 0.0);
    EXPECT_EQ(none.mapped, 0.0);
    EXPECT_TRUE(none.information.isZero());
    const Registration blind =
        register_points(SurfaceMap(0.5), random.points(100, 9.0), start, {}, 0.5);
    EXPECT_TRUE(blind.T_map_sensor.isApprox(start, 1e-9));
    EXPECT_EQ(blind.mapped, 0.0);
    const PosePrior prior{random.pose(3.0, 1.0), Information::Identity()};
    const Registration expected =
        register_points(SurfaceMap(0.5), random.points(100, 9.0), start, prior, 0.5);
    EXPECT_TRUE(expected.T_map_sensor.isApprox(prior.T_map_sensor, 1e-4));
}

/// By central differences: how far a point is off its surface after a small displacement.
Twist slope(const Surface& surface, const Pose& T, const Point& p) {
    constexpr double kStep = 1e-5;
    Twist out;
    for (int k = 0; k < 6; ++k) {
        const auto distance = [&](double step) {
            const Twist by = step * Twist::Unit(k);
            const Eigen::Vector3d q = T * exp(by) * p.cast<double>();
            return surface.normal.cast<double>().dot(q - surface.point.cast<double>());
        };
        out[k] = (distance(kStep) - distance(-kStep)) / (2.0 * kStep);
    }
    return out;
}

TEST(Registration, InformationIsTheCurvatureOfTheCost) {
    test::Random random(6);
    const SurfaceMap map = map_of(test::hall(), 0.0, random);
    const Pose truth = random.pose(0.2, 2.0 * kDegree);
    const Points points = seen_from(truth, test::hall(), 0.0, random);
    const Registration found = register_points(map, points, truth, {}, 0.1);
    Information expected = Information::Zero();
    for (const Point& p : points) {
        const Point q = (found.T_map_sensor * p.cast<double>()).cast<float>();
        const Surface* surface = map.at(q);
        if (surface == nullptr) continue;
        const Twist J = slope(*surface, found.T_map_sensor, p);
        const auto variance = static_cast<double>(surface->variance_at(q));
        const double residual = static_cast<double>(surface->normal.dot(q - surface->point));
        const double scale = std::max(0.08 * 0.08, 9.0 * variance);
        const double inlier = std::pow(scale / (scale + residual * residual), 2);
        const Eigen::Vector3d in_sensor =
            found.T_map_sensor.linear().transpose() * surface->normal.cast<double>();
        const double cosine = in_sensor.dot(p.cast<double>().normalized());
        const double incidence = cosine * cosine / (cosine * cosine + 0.1 * 0.1);
        expected += 0.1 * inlier * incidence / variance * J * J.transpose();
    }
    EXPECT_LT((found.information - expected).norm(), 0.01 * expected.norm());
    EXPECT_TRUE(found.information.isApprox(found.information.transpose(), 0.0));
}

TEST(BlurOnMap, GrowsWithTheErrorOfThePose) {
    test::Random random(7);
    const SurfaceMap map = map_of(test::hall(), 0.01, random);
    const Points points = seen_from(Pose::Identity(), test::hall(), 0.01, random);
    double before = 0.0;
    for (const double shift : {0.0, 0.02, 0.05, 0.1, 0.3}) {
        const Pose pose(Eigen::Translation3d(shift, shift, shift));
        const double blur = blur_on_map(map, points, pose);
        EXPECT_GT(blur, before) << shift;
        before = blur;
    }
    EXPECT_LT(before, 0.5);
    EXPECT_DOUBLE_EQ(blur_on_map(map, {}, Pose::Identity()), 0.5);
    EXPECT_NEAR(blur_on_map(SurfaceMap(0.5), points, Pose::Identity()), 0.5, 1e-9);
}

}  // namespace registration_test
}  // namespace dynamic_filter
