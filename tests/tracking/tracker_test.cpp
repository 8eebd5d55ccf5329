// SPDX-License-Identifier: MIT
#include "tracking/tracker.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/simulation.hpp"
#include "support/random.hpp"
#include "support/room.hpp"
#include "tracking/beginning.hpp"

namespace dynamic_filter {
namespace tracker_test {

using test::drive;
using test::RoomScan;

std::vector<Scan> scans_of(std::size_t count, bool with_poses) {
    std::vector<Scan> scans;
    for (const RoomScan& s : drive(count, true)) {
        scans.push_back(s.scan);
        scans.back().has_pose = with_poses;
    }
    return scans;
}

OdometryConfig refining() {
    OdometryConfig config;
    config.refine = true;
    return config;
}

/// Tracks each scan, and learns all of it.
std::vector<Pose> poses_by(Tracker& tracker, std::vector<Scan> scans) {
    std::vector<Pose> poses;
    for (Scan& scan : scans) {
        tracker.place(scan);
        tracker.learn({});
        poses.push_back(scan.T_world_sensor);
    }
    return poses;
}

std::string error_of(Tracker& tracker, Scan scan) {
    try {
        tracker.place(scan);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// [m] root mean square.
double off(const std::vector<Pose>& poses, const std::vector<Scan>& truth) {
    double sum = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        sum += (poses[i].translation() - truth[i].T_world_sensor.translation()).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(poses.size()));
}

TEST(Tracker, GivenPosesAreTakenAsTheyAre) {
    Tracker tracker({});
    for (Scan scan : scans_of(4, true)) {
        const Scan before = scan;
        EXPECT_FALSE(tracker.place(scan));
        EXPECT_EQ(scan.T_world_sensor.matrix(), before.T_world_sensor.matrix());
        EXPECT_EQ(scan.points, before.points);
    }
    tracker.learn({});  // there is nothing to learn
    EXPECT_EQ(tracker.times().count(), 0U);
}

TEST(Tracker, ScansWithoutPosesGetThem) {
    const auto truth = scans_of(20, true);
    Tracker tracker({});
    auto scans = scans_of(20, false);
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const auto tracked = tracker.place(scans[i]);
        tracker.learn({});
        ASSERT_TRUE(tracked);
        EXPECT_EQ(tracked->T_world_sensor.matrix(), scans[i].T_world_sensor.matrix());
        EXPECT_TRUE(scans[i].has_pose);
        const Pose expected = truth[0].T_world_sensor.inverse() * truth[i].T_world_sensor;
        EXPECT_LT(log(expected.inverse() * scans[i].T_world_sensor).norm(), 0.03) << i;
    }
    EXPECT_EQ(tracker.times().count(), 40U);
}

TEST(Tracker, OnlySomeScansWithPosesIsAnErrorThatNamesTheScan) {
    for (const bool first_has : {false, true}) {
        Tracker tracker({});
        auto scans = scans_of(3, first_has);
        scans[1].has_pose = !first_has;
        tracker.place(scans[0]);
        const std::string error = error_of(tracker, scans[1]);
        EXPECT_EQ(error, first_has ? "scan 1 has no pose, but those before had one"
                                   : "scan 1 has a pose, but those before had none");
    }
}

TEST(Tracker, TimesMustBeAsManyAsPoints) {
    for (const bool with_poses : {false, true}) {
        Tracker tracker(refining());
        auto scans = scans_of(1, with_poses);
        scans[0].times.assign(7, 0.0F);
        EXPECT_EQ(error_of(tracker, scans[0]), "scan 0 has 7 times, but 3840 points");
    }
}

TEST(Tracker, MotionDuringAScanIsUndone) {
    Tracker tracker({});
    for (Scan& scan : scans_of(4, false)) {
        scan.times.assign(scan.points.size(), 0.2F);  // [s] after the stamp
        const Points before = scan.points;
        tracker.place(scan);
        tracker.learn({});
        EXPECT_TRUE(scan.times.empty());
        const float moved = (scan.points[0] - before[0]).x(), expected = 0.2F * 2.0F / 16.0F;
        EXPECT_NEAR(moved, scan.index == 0 ? 0.0F : expected, 0.01F);
    }
}

TEST(Tracker, AfterARestartTheWorldIsTheNextScansSensorFrame) {
    Tracker tracker({});
    auto scans = scans_of(6, false);
    for (std::size_t i = 0; i < scans.size(); ++i) {
        if (i == 3) tracker.restart();
        tracker.place(scans[i]);
        tracker.learn({});
    }
    EXPECT_TRUE(scans[3].T_world_sensor.isApprox(Pose::Identity()));
    EXPECT_FALSE(scans[4].T_world_sensor.isApprox(Pose::Identity(), 1e-3));
}

TEST(Tracker, RefinedExactPosesStayWhereTheyAre) {
    const auto scans = scans_of(30, true);
    Tracker tracker(refining());
    const auto poses = poses_by(tracker, scans);
    for (std::size_t i = 0; i < scans.size(); ++i) {
        EXPECT_LT((poses[i].translation() - scans[i].T_world_sensor.translation()).norm(), 0.01);
    }
}

TEST(Tracker, RefinedNoisyPosesAreNearerToTheTruth) {
    const auto truth = scans_of(30, true);
    auto scans = truth;
    test::Random random(1);
    std::vector<Pose> given;
    for (Scan& scan : scans) {
        scan.T_world_sensor = scan.T_world_sensor *
                              random.pose(0.03 * std::sqrt(3.0), 0.2 * std::numbers::pi / 180.0);
        given.push_back(scan.T_world_sensor);
    }
    Tracker tracker(refining());
    auto poses = poses_by(tracker, scans);
    // the first one is taken as given
    const Pose back = truth[0].T_world_sensor * given[0].inverse();
    for (Pose& pose : poses) pose = back * pose;
    EXPECT_LT(off(poses, truth), 0.3 * off(given, truth));
}

TEST(Tracker, WhereGivenPosesDriftSlowlyTheyAreFollowed) {
    auto scans = scans_of(60, true);
    const std::vector<Scan> truth = scans;
    for (Scan& scan : scans) scan.T_world_sensor.translation() *= 1.05;  // 5 % of the way
    OdometryConfig config = refining();
    config.return_over = 1.0;  // [m]; the way is 3.7 m
    Tracker tracker(config);
    const auto poses = poses_by(tracker, scans);
    const Eigen::Vector3d last = scans.back().T_world_sensor.translation();
    EXPECT_GT((truth.back().T_world_sensor.translation() - last).norm(), 0.17);
    EXPECT_LT((poses.back().translation() - last).norm(), 0.07);
    config.return_over = 1e6;  // never
    Tracker faithful(config);
    EXPECT_LT(
        (poses_by(faithful, scans).back().translation() - scans[0].T_world_sensor.translation() -
         truth.back().T_world_sensor.translation() + truth[0].T_world_sensor.translation())
            .norm(),
        0.03);
}

TEST(Tracker, AfterARestartRefinedPosesBeginAtTheGivenOne) {
    auto scans = scans_of(12, true);
    for (std::size_t i = 6; i < 12; ++i) scans[i].T_world_sensor.translation().x() += 1000.0;
    Tracker tracker(refining());
    for (std::size_t i = 0; i < scans.size(); ++i) {
        if (i == 6) tracker.restart();
        const Eigen::Vector3d given = scans[i].T_world_sensor.translation();
        tracker.place(scans[i]);
        tracker.learn({});
        EXPECT_LT((scans[i].T_world_sensor.translation() - given).norm(), 0.01) << i;
    }
}

TEST(Tracker, BeginsAnewWithTheScanThatTheOdometryGaveUpAt) {
    auto scans = scans_of(14, false);
    for (std::size_t i = 3; i < 13; ++i) scans[i].points.clear();
    Tracker tracker({});
    for (Scan& scan : scans) {
        EXPECT_EQ(tracker.place(scan)->begins_anew, scan.index == 12) << scan.index;
        tracker.learn({});
    }
}

/// To a solid-state sensor, which sees little of a street, it looks as if it stood still, until the
/// first scans are known.
TEST(Tracker, SetsOutAgainIfTheFirstScansShowAnotherVelocity) {
    sim::SimulationOptions options;
    options.scene = "street";
    options.sensor = "solid";
    options.seed = 1;
    options.rate_hz = 10.0;
    options.frames = 40;
    sim::Simulation simulation(options);
    Tracker tracker({});
    std::vector<Pose> truth, found;
    std::size_t anew = 0;
    for (std::size_t i = 0; i < kBeginning + 5; ++i) {
        sim::SimulatedScan s = simulation.scan(i);
        truth.push_back(s.T_world_sensor);
        Scan scan{std::move(s.points), Pose::Identity(), s.stamp, i, false};
        const auto tracked = tracker.place(scan);
        tracker.learn({});
        anew += tracked->begins_anew ? 1 : 0;
        EXPECT_TRUE(!tracked->begins_anew || i + 1 == kBeginning) << i;
        found.push_back(scan.T_world_sensor);
    }
    EXPECT_EQ(anew, 1U);
    for (std::size_t i = kBeginning; i < truth.size(); ++i) {
        const Pose moved = truth[i - 1].inverse() * truth[i];
        const Pose as_found = found[i - 1].inverse() * found[i];
        EXPECT_LT((moved.translation() - as_found.translation()).norm(), 0.05) << i;
    }
}

}  // namespace tracker_test
}  // namespace dynamic_filter
