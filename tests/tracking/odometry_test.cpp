// SPDX-License-Identifier: MIT
// In a hall whose points are drawn by formula; see accuracy/odometry_test.cpp for whole scenes.
#include "dynamic_filter/tracking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dynamic_filter/parallel.hpp"
#include "support/drive.hpp"
#include "support/planes.hpp"

namespace dynamic_filter {
namespace odometry_odometry_test {

using test::Drive;
using test::lost;
using test::off_between;
using test::track;

/// How the sensor moves, with a bend; or it stands.
Pose pose_at(double t, double speed) {
    Twist velocity;
    velocity << speed, 0, 0, 0, 0, speed > 0.0 ? 0.15 : 0.0;
    return Eigen::Translation3d(-6.0, -4.0, 0.1) * exp(velocity * t);
}

Point seen(const Point& p, double t, double speed) {
    return (pose_at(t, speed).inverse() * p.cast<double>()).cast<float>();
}

/// A scan at 10 Hz; while the sensor turns once if `sweeping`.
Scan scan_at(std::size_t i, double speed, bool sweeping, test::Random& random) {
    const double stamp = 0.1 * static_cast<double>(i);
    Scan scan{.points = {}, .stamp = stamp, .index = i, .has_pose = false};
    for (const Point& p : test::points_on(test::hall(), 4.0, 0.02, random)) {
        scan.points.push_back(seen(p, stamp, speed));
        if (!sweeping) continue;
        const Point& there = scan.points.back();
        const double turned = std::atan2(there.y(), there.x()) / (2.0 * std::numbers::pi) + 0.5;
        scan.times.push_back(static_cast<float>(0.1 * turned));
        scan.points.back() = seen(p, stamp + 0.1 * turned, speed);
    }
    return scan;
}

Drive drive(std::size_t count, double speed, bool sweeping = false) {
    test::Random random(1);
    Drive drive;
    for (std::size_t i = 0; i < count; ++i) {
        drive.scans.push_back(scan_at(i, speed, sweeping, random));
        drive.truth.push_back(pose_at(drive.scans.back().stamp, speed));
    }
    return drive;
}

Scan noise_at(double stamp, test::Random& random) {
    return {.points = random.points(3000, 20.0), .stamp = stamp, .has_pose = false};
}

void expect_close(const Twist& off, double shift, double turn) {
    EXPECT_LT(off.head<3>().norm(), shift);
    EXPECT_LT(off.tail<3>().norm(), turn);
}

TEST(Odometry, FollowsTheSensorFromAStartAtFullSpeed) {
    for (const bool sweeping : {false, true}) {
        for (const double speed : {0.5, 5.0, 10.0}) {
            const Drive way = drive(15, speed, sweeping);
            const auto tracked = track(way.scans);
            EXPECT_EQ(lost(tracked), 0U);
            for (std::size_t i = 0; i < tracked.size(); ++i) {
                SCOPED_TRACE(i);
                expect_close(off_between(way, tracked, 0, i), 0.03, 0.003);
                EXPECT_FALSE(tracked[i].begins_anew);
                if (i == 0) continue;
                EXPECT_NEAR(tracked[i].velocity[0], speed, 0.4) << speed;
                EXPECT_NEAR(tracked[i].velocity[5], 0.15, 0.04) << speed;
                EXPECT_GT(tracked[i].inliers, 0.7);
            }
        }
    }
}

TEST(Odometry, TheWorldIsTheFirstScansSensorFrame) {
    const Drive way = drive(2, 1.0);
    const auto tracked = track(way.scans);
    EXPECT_EQ(tracked[0].T_world_sensor.matrix(), Pose::Identity().matrix());
    EXPECT_EQ(tracked[0].status, TrackStatus::good);
}

TEST(Odometry, ASensorThatStandsStillDoesNotDrift) {
    for (const Tracked& t : track(drive(50, 0.0).scans)) {
        EXPECT_LT(t.T_world_sensor.translation().norm(), 5e-3);
        EXPECT_LT(log(t.T_world_sensor).tail<3>().norm(), 1e-3);
    }
}

TEST(Odometry, GoesOnAfterAGap) {
    Drive way = drive(25, 4.0);
    way.scans.erase(way.scans.begin() + 10, way.scans.begin() + 16);
    way.truth.erase(way.truth.begin() + 10, way.truth.begin() + 16);
    const auto tracked = track(way.scans);
    EXPECT_EQ(lost(tracked), 0U);
    expect_close(off_between(way, tracked, 0, tracked.size() - 1), 0.03, 0.003);
}

/// The same to the last bit.
void expect_same(const std::vector<Tracked>& a, const std::vector<Tracked>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].T_world_sensor.matrix(), b[i].T_world_sensor.matrix());
        EXPECT_EQ(a[i].velocity, b[i].velocity);
        EXPECT_EQ(a[i].covariance, b[i].covariance);
        EXPECT_EQ(a[i].inliers, b[i].inliers);
    }
}

TEST(Odometry, SameScansSameBits) {
    const Drive way = drive(10, 5.0, true);
    std::vector<Tracked> one, four;
    with_threads(1, [&] { one = track(way.scans); });
    with_threads(4, [&] { four = track(way.scans); });
    expect_same(one, four);
    expect_same(one, track(way.scans));
}

/// The sensor is carried elsewhere with scan 10: everything lies 30 m and a quarter turn away.
Drive carried_away(bool sweeping) {
    Drive way = drive(40, 2.0, sweeping);
    const Drive other = drive(40, 3.0, sweeping);
    const Pose elsewhere(Eigen::Translation3d(30.0, 0.0, 0.0) *
                         Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitZ()));
    for (std::size_t i = 10; i < 40; ++i) {
        way.scans[i] = other.scans[i - 10];
        way.scans[i].stamp = 0.1 * static_cast<double>(i);
        for (Point& p : way.scans[i].points) p = elsewhere.cast<float>() * p;
        way.truth[i] = other.truth[i - 10] * elsewhere.inverse();
    }
    return way;
}

TEST(Odometry, AfterManyLostScansANewMapBegins) {
    for (const bool sweeping : {false, true}) {
        const Drive way = carried_away(sweeping);
        const auto tracked = track(way.scans);
        for (std::size_t i = 0; i < tracked.size(); ++i) {
            SCOPED_TRACE(i);
            EXPECT_EQ(tracked[i].begins_anew, i == 19);
            EXPECT_EQ(tracked[i].status == TrackStatus::lost, i >= 10 && i < 20);
            if (i >= 20 && !sweeping) expect_close(off_between(way, tracked, 19, i), 0.05, 0.004);
        }
    }
}

TEST(Odometry, RecoversFromMuchNoise) {
    Drive way = drive(45, 2.0);
    test::Random random(3);
    for (std::size_t i = 10; i < 23; ++i) way.scans[i] = noise_at(way.scans[i].stamp, random);
    const auto tracked = track(way.scans);
    EXPECT_TRUE(tracked[19].begins_anew);
    for (std::size_t i = 33; i < 45; ++i) {
        EXPECT_NE(tracked[i].status, TrackStatus::lost) << i;
        expect_close(off_between(way, tracked, 33, i), 0.03, 0.004);
    }
}

TEST(Odometry, AFewLostScansAreBridged) {
    Drive way = drive(25, 2.0);
    test::Random random(4);
    for (std::size_t i = 10; i < 15; ++i) way.scans[i] = noise_at(way.scans[i].stamp, random);
    const auto tracked = track(way.scans);
    EXPECT_EQ(lost(tracked), 5U);
    expect_close(off_between(way, tracked, 0, 24), 0.03, 0.003);
    for (const Tracked& t : tracked) EXPECT_FALSE(t.begins_anew);
}

TEST(Odometry, ScansWithoutAnythingToUseAreLost) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    Drive way = drive(12, 2.0);
    way.scans[4].points.clear();
    way.scans[5].points.assign(100, {kNan, kNan, kNan});
    way.scans[6].points.assign(100, Point::Zero());
    const auto tracked = track(way.scans);
    for (const std::size_t i : {4U, 5U, 6U}) EXPECT_EQ(tracked[i].status, TrackStatus::lost);
    EXPECT_EQ(lost(tracked), 3U);
    expect_close(off_between(way, tracked, 0, 11), 0.03, 0.003);
}

TEST(Odometry, BeginsWithTheFirstScanThatHasPoints) {
    Drive way = drive(12, 2.0);
    for (std::size_t i = 0; i < 3; ++i) way.scans[i].points.clear();
    const auto tracked = track(way.scans);
    EXPECT_EQ(lost(tracked), 0U);
    expect_close(off_between(way, tracked, 3, 11), 0.03, 0.003);
}

/// Tracks with the true motion, or one that is off, as the guess.
std::vector<Tracked> track_guessed(const Drive& way, const Pose& off) {
    Odometry odometry(OdometryConfig{});
    std::vector<Tracked> tracked;
    for (std::size_t i = 0; i < way.scans.size(); ++i) {
        const Scan& scan = way.scans[i];
        std::optional<Pose> guess;
        if (i > 0) guess = way.truth[i - 1].inverse() * way.truth[i] * off;
        tracked.push_back(odometry.track(scan.points, scan.times, scan.stamp, guess));
        odometry.learn({});
    }
    return tracked;
}

TEST(Odometry, AGuessIsAFirstGuessOnly) {
    const Drive way = drive(12, 5.0, true);
    for (const Pose& off : {Pose::Identity(), Pose(Eigen::Translation3d(0.01, -0.01, 0.01))}) {
        const auto tracked = track_guessed(way, off);
        EXPECT_EQ(lost(tracked), 0U);
        expect_close(off_between(way, tracked, 0, 11), 0.03, 0.003);
    }
}

TEST(Odometry, TheFirstScanStaysWhereItWasIfTheSecondIsLost) {
    Drive way = drive(12, 5.0, true);
    test::Random random(5);
    way.scans[1] = noise_at(way.scans[1].stamp, random);
    way.scans[1].times.assign(way.scans[1].points.size(), 0.05F);
    const auto tracked = track_guessed(way, Pose::Identity());
    EXPECT_EQ(lost(tracked), 1U);
    expect_close(off_between(way, tracked, 0, 11), 0.03, 0.003);
}

TEST(Odometry, WhatIsLabelledDynamicIsNoLandmark) {
    Drive way = drive(2, 0.0);
    Odometry odometry(OdometryConfig{});
    odometry.track(way.scans[0].points, {}, 0.0);
    odometry.learn(Labels(way.scans[0].points.size(), Label::dynamic));
    const Tracked second = odometry.track(way.scans[1].points, {}, 0.1);  // there is no map yet
    EXPECT_EQ(second.T_world_sensor.matrix(), Pose::Identity().matrix());
    odometry.learn({});
    EXPECT_GT(odometry.track(way.scans[1].points, {}, 0.2).inliers, 0.9);
}

TEST(Odometry, AMovedOdometryGoesOn) {
    const Drive way = drive(6, 3.0);
    Odometry first(OdometryConfig{});
    first.track(way.scans[0].points, {}, way.scans[0].stamp);
    first.learn({});
    Odometry odometry(std::move(first));
    first = Odometry(OdometryConfig{});
    std::vector<Tracked> tracked(1);
    for (std::size_t i = 1; i < way.scans.size(); ++i) {
        tracked.push_back(odometry.track(way.scans[i].points, {}, way.scans[i].stamp));
        odometry.learn({});
    }
    expect_same({tracked.begin() + 1, tracked.end()}, [&] {
        const auto all = track(way.scans);
        return std::vector<Tracked>(all.begin() + 1, all.end());
    }());
}

TEST(Odometry, CovarianceIsThatOfARegistration) {
    for (const Tracked& t : track(drive(6, 1.0).scans)) {
        EXPECT_TRUE(t.covariance.isApprox(t.covariance.transpose(), 1e-9));
        EXPECT_GE(t.covariance.diagonal().minCoeff(), 0.0);
        EXPECT_LT(std::sqrt(t.covariance.diagonal().maxCoeff()), 0.02);
    }
}

}  // namespace odometry_odometry_test
}  // namespace dynamic_filter
