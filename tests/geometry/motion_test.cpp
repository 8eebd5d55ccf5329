// SPDX-License-Identifier: MIT
#include "dynamic_filter/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/random.hpp"

namespace dynamic_filter {
namespace motion_test {

Twist random_twist(test::Random& random, double reach, double angle) {
    Twist twist;
    twist << random.point(reach).cast<double>(), angle * random.direction();
    return twist;
}

/// The power series of the 4 x 4 matrix.
Eigen::Matrix4d exp_by_series(const Twist& twist) {
    Eigen::Matrix4d x = Eigen::Matrix4d::Zero();
    const Eigen::Vector3d w = twist.tail<3>();
    x.topLeftCorner<3, 3>() << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
    x.topRightCorner<3, 1>() = twist.head<3>();
    Eigen::Matrix4d term = Eigen::Matrix4d::Identity(), sum = term;
    for (int k = 1; k < 60; ++k) {
        term = term * x / k;
        sum += term;
    }
    return sum;
}

const std::vector<double> kAngles = {0.0,
                                     1e-15,
                                     1e-12,
                                     1e-9,
                                     9.9e-9,
                                     1.1e-8,
                                     1e-7,
                                     1e-5,
                                     1e-3,
                                     0.1,
                                     1.0,
                                     3.0,
                                     std::numbers::pi - 1e-3,
                                     std::numbers::pi - 1e-6};

TEST(Motion, ExpIsThePowerSeries) {
    test::Random random(1);
    for (const double angle : kAngles) {
        for (int i = 0; i < 20; ++i) {
            const Twist twist = random_twist(random, 10.0, angle);
            const Pose pose = exp(twist);
            EXPECT_TRUE(pose.matrix().isApprox(exp_by_series(twist), 1e-9)) << angle;
            EXPECT_TRUE((pose.linear() * pose.linear().transpose()).isIdentity(1e-12));
        }
    }
}

TEST(Motion, LogUndoesExp) {
    test::Random random(2);
    for (const double angle : kAngles) {
        for (int i = 0; i < 50; ++i) {
            const Twist twist = random_twist(random, 10.0, angle);
            EXPECT_LT((log(exp(twist)) - twist).norm(), 1e-8) << angle;
        }
    }
}

TEST(Motion, ExpUndoesLog) {
    test::Random random(3);
    for (int i = 0; i < 200; ++i) {
        const Pose pose = random.pose(100.0, 3.1);
        EXPECT_TRUE(exp(log(pose)).isApprox(pose, 1e-9));
    }
    EXPECT_TRUE(log(Pose::Identity()).isZero());
}

TEST(Motion, ManySmallStepsMakeALargeOne) {
    test::Random random(4);
    for (const double angle : {0.0, 1e-6, 0.5, 2.0, 6.0}) {
        const Twist twist = random_twist(random, 10.0, angle);
        const Pose step = exp(twist / 1000.0);
        Pose all = Pose::Identity();
        for (int i = 0; i < 1000; ++i) all = all * step;
        EXPECT_TRUE(exp(twist).isApprox(all, 1e-9)) << angle;
    }
}

TEST(Motion, MovedPointsAreThePosesImages) {
    test::Random random(5);
    const Pose pose = random.pose(20.0, 3.0);
    const Points points = random.points(100, 30.0), there = moved(points, pose);
    ASSERT_EQ(there.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_LT((there[i].cast<double>() - pose * points[i].cast<double>()).norm(), 1e-4);
    }
    EXPECT_TRUE(moved({}, pose).empty());
}

/// A place as a sensor measures it that has moved on for a while.
Point seen_later(const Point& at_stamp, double time, const Twist& velocity) {
    return (exp(time * velocity).inverse() * at_stamp.cast<double>()).cast<float>();
}

TEST(Motion, UndoneSweepsAreSnapshots) {
    test::Random random(6);
    for (int i = 0; i < 20; ++i) {
        const Twist velocity = random_twist(random, 20.0, random.uniform(0.0, 3.0));
        const Points snapshot = random.points(500, 50.0);
        Points swept;
        std::vector<float> times;
        for (const Point& p : snapshot) {
            times.push_back(random.uniform_f(-0.1, 0.2));
            swept.push_back(seen_later(p, static_cast<double>(times.back()), velocity));
        }
        // times are taken to a tenth of a millisecond
        const double fastest = velocity.head<3>().norm() + 87.0 * velocity.tail<3>().norm();
        const auto tolerance = static_cast<float>(0.5e-4 * fastest + 1e-4);
        const Points undone = undo_motion(swept, times, velocity);
        for (std::size_t k = 0; k < snapshot.size(); ++k) {
            ASSERT_LT((undone[k] - snapshot[k]).norm(), tolerance);
        }
    }
}

TEST(Motion, WithoutATimeOrAMeasurementPointsStay) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInf = std::numeric_limits<float>::infinity();
    Twist velocity;
    velocity << 10, 0, 0, 0, 0, 1;
    const Points points = {{1, 2, 3}, {1, 2, 3}, Point::Zero(), {kNan, 1, 1}, {1, 2, 3}};
    const Points undone =
        undo_motion(points, std::vector<float>{kNan, kInf, 0.1F, 0.1F, 0.0F}, velocity);
    for (const std::size_t i : {0U, 1U, 2U, 4U}) EXPECT_EQ(undone[i], points[i]) << i;
    EXPECT_TRUE(std::isnan(undone[3].x()));
    EXPECT_EQ(undone[3].tail<2>(), points[3].tail<2>());
    EXPECT_TRUE(undo_motion({}, {}, velocity).empty());
}

}  // namespace motion_test
}  // namespace dynamic_filter
