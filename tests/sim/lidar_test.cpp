// SPDX-License-Identifier: MIT
#include "sim/lidar.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dynamic_filter/motion.hpp"

namespace dynamic_filter::sim::lidar_test {

using dynamic_filter::Label;
using dynamic_filter::Pose;

namespace {

constexpr double wall_distance = 10.0;

/// A square room around the sensor; the floor is 1 m below.
Mesh room() {
    Mesh mesh;
    add_box(mesh, Eigen::Affine3d::Identity(),
            {Eigen::Vector3d(-wall_distance, -wall_distance, -1.0),
             Eigen::Vector3d(wall_distance, wall_distance, 20.0)},
            0.5F);
    return mesh;
}

}  // namespace

TEST(Lidar, ResidualsHaveTheSensorsNoise) {
    const Sensor& sensor = sensor_table().front();
    const Caster caster(room(), {}, {});
    const Returns returns = sense(caster, sensor, Pose::Identity(), 1, 0);
    ASSERT_GT(returns.points.size(), 20000U);
    double squares = 0.0;
    std::size_t count = 0;
    for (const auto& p : returns.points) {
        const double across = static_cast<double>(std::max(std::abs(p.x()), std::abs(p.y())));
        if (p.z() < -0.7F &&
            across <
                wall_distance - 0.2) {  // along the ray the noise is larger than across the floor
            EXPECT_NEAR(p.z(), -1.0F, 0.06F);
        } else if (p.z() > -0.5F && p.z() < 1.0F) {
            const double along = (across - wall_distance) * static_cast<double>(p.norm()) / across;
            squares += along * along;
            ++count;
            EXPECT_LT(std::abs(along), 6.0 * sensor.sigma);
        }
    }
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(count)), sensor.sigma, 0.02 * sensor.sigma);
}

TEST(Lidar, RangesAreQuantisedAndWithinLimits) {
    for (const Sensor& sensor : sensor_table()) {
        const Caster caster(room(), {}, {});
        const Returns returns = sense(caster, sensor, Pose::Identity(), 1, 2);
        ASSERT_EQ(returns.points.size(), returns.labels.size());
        ASSERT_EQ(returns.points.size(), returns.intensity.size());
        ASSERT_EQ(returns.points.size(), returns.kinds.size());
        ASSERT_FALSE(returns.points.empty());
        for (std::size_t i = 0; i < returns.points.size(); ++i) {
            const double steps = static_cast<double>(returns.points[i].norm()) / 0.002;
            EXPECT_NEAR(steps, std::round(steps), 0.02);
            EXPECT_GE(returns.intensity[i], 0.0F);
            EXPECT_LE(returns.intensity[i], 1.0F);
            EXPECT_EQ(returns.labels[i], Label::static_);
            EXPECT_EQ(returns.kinds[i], Kind::structure);
        }
    }
}

TEST(Lidar, GrazingAndFarReturnsAreLostMoreOften) {
    const Sensor& sensor = sensor_table().front();
    Mesh floor;
    add_quad(floor, {-200, -200, -1}, {400, 0, 0}, {0, 400, 0}, 0.3F);
    const Caster caster(floor, {}, {});
    const Returns returns = sense(caster, sensor, Pose::Identity(), 1, 0);
    std::size_t near = 0, far = 0;  // the beams at -15 and at -1 degrees, 1800 rays each
    for (const auto& p : returns.points) {
        const double elevation = std::asin(static_cast<double>(p.normalized().z())) * 57.29578;
        near += std::abs(elevation + 15.0) < 0.2;
        far += std::abs(elevation + 1.0) < 0.2;
    }
    EXPECT_GT(near, 1700U);
    EXPECT_LT(far, 900U);
}

TEST(Lidar, NothingNearerThanTheBlindZone) {
    Mesh cage;
    add_box(cage, Eigen::Affine3d::Identity(),
            {Eigen::Vector3d(-0.2, -0.2, -0.2), Eigen::Vector3d(0.2, 0.2, 0.2)}, 0.5F);
    const Caster caster(cage, {}, {});
    EXPECT_TRUE(sense(caster, sensor_table().front(), Pose::Identity(), 1, 0).points.empty());
}

TEST(Sweep, OfASensorThatStandsIsASnapshot) {
    const Caster caster(room(), {}, {});
    Pose pose = Pose::Identity();
    pose.translation() = Eigen::Vector3d(1.0, -2.0, 0.5);
    for (const Sensor& sensor : sensor_table()) {
        const Returns one = sense(caster, sensor, pose, 3, 4);
        const Returns two = sweep(
            caster, sensor, [&](double) { return pose; }, [](double) {}, 3, 4);
        EXPECT_EQ(one.points, two.points) << sensor.name;
        EXPECT_EQ(one.intensity, two.intensity);
        EXPECT_EQ(one.labels, two.labels);
        EXPECT_EQ(one.shares, two.shares);
    }
}

TEST(Sweep, SharesAndSlicesGoOnFromBeginningToEnd) {
    const Caster caster(room(), {}, {});
    std::vector<double> told;
    const Returns returns = sweep(
        caster, sensor_table().front(), [](double) { return Pose::Identity(); },
        [&](double share) { told.push_back(share); }, 1, 0);
    ASSERT_EQ(returns.shares.size(), returns.points.size());
    EXPECT_TRUE(std::is_sorted(returns.shares.begin(), returns.shares.end()));
    EXPECT_GE(returns.shares.front(), 0.0F);
    EXPECT_LT(returns.shares.back(), 1.0F);
    EXPECT_GT(returns.shares.back(), 0.9F);
    ASSERT_GT(told.size(), 10U);
    for (std::size_t i = 0; i < told.size(); ++i) {
        EXPECT_NEAR(told[i], (static_cast<double>(i) + 0.5) / static_cast<double>(told.size()),
                    1e-9);
    }
}

TEST(Sweep, IsStraightOnceTheMotionIsUndone) {
    const Sensor& sensor = sensor_table().front();
    const Caster caster(room(), {}, {});
    dynamic_filter::Twist velocity;  // per sweep
    velocity << 2.0, 0.5, 0.0, 0.0, 0.0, 0.3;
    const Returns returns = sweep(
        caster, sensor, [&](double share) { return dynamic_filter::exp(share * velocity); },
        [](double) {}, 1, 0);
    const auto off_walls = [&](const dynamic_filter::Points& points) {
        double squares = 0.0, count = 0.0;
        for (const auto& p : points) {
            if (p.z() < -0.5F || p.z() > 1.0F) continue;
            const double across = static_cast<double>(std::max(std::abs(p.x()), std::abs(p.y())));
            squares += std::pow(across - wall_distance, 2);
            count += 1.0;
        }
        return std::sqrt(squares / count);
    };
    EXPECT_GT(off_walls(returns.points), 0.5);
    EXPECT_LT(off_walls(dynamic_filter::undo_motion(returns.points, returns.shares, velocity)),
              sensor.sigma * 1.1);
}

}  // namespace dynamic_filter::sim::lidar_test
