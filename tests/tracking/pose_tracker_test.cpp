// SPDX-License-Identifier: MIT
#include "tracking/pose_tracker.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "dynamic_filter/error.hpp"
#include "support/random.hpp"
#include "support/room.hpp"

namespace dynamic_filter {
namespace pose_tracker_test {

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
std::vector<Pose> poses_by(PoseTracker& tracker, std::vector<Scan> scans) {
    std::vector<Pose> poses;
    for (Scan& scan : scans) {
        tracker.track(scan);
        tracker.learn({});
        poses.push_back(scan.T_world_sensor);
    }
    return poses;
}

std::string error_of(PoseTracker& tracker, Scan scan) {
    try {
        tracker.track(scan);
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

TEST(PoseTracker, GivenPosesAreTakenAsTheyAre) {
    PoseTracker tracker({});
    for (Scan scan : scans_of(4, true)) {
        const Scan before = scan;
        EXPECT_FALSE(tracker.track(scan));
        EXPECT_EQ(scan.T_world_sensor.matrix(), before.T_world_sensor.matrix());
        EXPECT_EQ(scan.points, before.points);
    }
    std::vector<Verdict> verdicts(1);
    EXPECT_TRUE(tracker.attach(verdicts).empty());
    EXPECT_FALSE(verdicts[0].tracked);
    EXPECT_FALSE(tracker.begins_anew());
    EXPECT_EQ(tracker.times().count(), 0U);
}

TEST(PoseTracker, ScansWithoutPosesGetThem) {
    const auto truth = scans_of(20, true);
    PoseTracker tracker({});
    auto scans = scans_of(20, false);
    for (std::size_t i = 0; i < scans.size(); ++i) {
        EXPECT_TRUE(tracker.track(scans[i]));
        tracker.learn({});
        EXPECT_TRUE(scans[i].has_pose);
        const Pose expected = truth[0].T_world_sensor.inverse() * truth[i].T_world_sensor;
        EXPECT_LT(log(expected.inverse() * scans[i].T_world_sensor).norm(), 0.03) << i;
    }
    EXPECT_EQ(tracker.times().count(), 40U);
}

TEST(PoseTracker, OnlySomeScansWithPosesIsAnErrorThatNamesTheScan) {
    for (const bool first_has : {false, true}) {
        PoseTracker tracker({});
        auto scans = scans_of(3, first_has);
        scans[1].has_pose = !first_has;
        tracker.track(scans[0]);
        const std::string error = error_of(tracker, scans[1]);
        EXPECT_EQ(error, first_has ? "scan 1 has no pose, but those before had one"
                                   : "scan 1 has a pose, but those before had none");
    }
}

TEST(PoseTracker, TimesMustBeAsManyAsPoints) {
    for (const bool with_poses : {false, true}) {
        PoseTracker tracker(refining());
        auto scans = scans_of(1, with_poses);
        scans[0].times.assign(7, 0.0F);
        EXPECT_EQ(error_of(tracker, scans[0]), "scan 0 has 7 times, but 3840 points");
    }
}

TEST(PoseTracker, MotionDuringAScanIsUndone) {
    PoseTracker tracker({});
    for (Scan& scan : scans_of(4, false)) {
        scan.times.assign(scan.points.size(), 0.2F);  // [s] after the stamp
        const Points before = scan.points;
        tracker.track(scan);
        tracker.learn({});
        EXPECT_TRUE(scan.times.empty());
        const float moved = (scan.points[0] - before[0]).x(), expected = 0.2F * 2.0F / 16.0F;
        EXPECT_NEAR(moved, scan.index == 0 ? 0.0F : expected, 0.01F);
    }
}

TEST(PoseTracker, VerdictsAreToldTheirScansPosesOnce) {
    PoseTracker tracker({});
    auto scans = scans_of(3, false);
    std::vector<Verdict> verdicts;
    for (Scan& scan : scans) {
        tracker.track(scan);
        tracker.learn({});
        verdicts.push_back({scan.index, Labels(5 + scan.index, Label::static_), {}});
    }
    EXPECT_EQ(tracker.attach(verdicts), verdicts[2].labels);
    for (std::size_t i = 0; i < scans.size(); ++i) {
        ASSERT_TRUE(verdicts[i].tracked);
        EXPECT_EQ(verdicts[i].tracked->T_world_sensor.matrix(), scans[i].T_world_sensor.matrix());
        verdicts[i].tracked.reset();
    }
    EXPECT_TRUE(tracker.attach(verdicts).empty());
    for (const Verdict& verdict : verdicts) EXPECT_FALSE(verdict.tracked);
}

TEST(PoseTracker, AfterARestartTheWorldIsTheNextScansSensorFrame) {
    PoseTracker tracker({});
    auto scans = scans_of(6, false);
    for (std::size_t i = 0; i < scans.size(); ++i) {
        if (i == 3) tracker.restart();
        tracker.track(scans[i]);
        tracker.learn({});
    }
    EXPECT_TRUE(scans[3].T_world_sensor.isApprox(Pose::Identity()));
    EXPECT_FALSE(scans[4].T_world_sensor.isApprox(Pose::Identity(), 1e-3));
}

TEST(PoseTracker, RefinedExactPosesStayWhereTheyAre) {
    const auto scans = scans_of(30, true);
    PoseTracker tracker(refining());
    const auto poses = poses_by(tracker, scans);
    for (std::size_t i = 0; i < scans.size(); ++i) {
        EXPECT_LT((poses[i].translation() - scans[i].T_world_sensor.translation()).norm(), 0.01);
    }
}

TEST(PoseTracker, RefinedNoisyPosesAreNearerToTheTruth) {
    const auto truth = scans_of(30, true);
    auto scans = truth;
    test::Random random(1);
    std::vector<Pose> given;
    for (Scan& scan : scans) {
        scan.T_world_sensor = scan.T_world_sensor *
                              random.pose(0.03 * std::sqrt(3.0), 0.2 * std::numbers::pi / 180.0);
        given.push_back(scan.T_world_sensor);
    }
    PoseTracker tracker(refining());
    auto poses = poses_by(tracker, scans);
    // the first one is taken as given
    const Pose back = truth[0].T_world_sensor * given[0].inverse();
    for (Pose& pose : poses) pose = back * pose;
    EXPECT_LT(off(poses, truth), 0.3 * off(given, truth));
}

TEST(PoseTracker, WhereGivenPosesDriftSlowlyTheyAreFollowed) {
    auto scans = scans_of(60, true);
    const std::vector<Scan> truth = scans;
    for (Scan& scan : scans) scan.T_world_sensor.translation() *= 1.05;  // 5 % of the way
    OdometryConfig config = refining();
    config.return_over = 1.0;  // [m]; the way is 3.7 m
    PoseTracker tracker(config);
    const auto poses = poses_by(tracker, scans);
    const Eigen::Vector3d last = scans.back().T_world_sensor.translation();
    EXPECT_GT((truth.back().T_world_sensor.translation() - last).norm(), 0.17);
    EXPECT_LT((poses.back().translation() - last).norm(), 0.07);
    config.return_over = 1e6;  // never
    PoseTracker faithful(config);
    EXPECT_LT(
        (poses_by(faithful, scans).back().translation() - scans[0].T_world_sensor.translation() -
         truth.back().T_world_sensor.translation() + truth[0].T_world_sensor.translation())
            .norm(),
        0.03);
}

TEST(PoseTracker, AfterARestartRefinedPosesBeginAtTheGivenOne) {
    auto scans = scans_of(12, true);
    for (std::size_t i = 6; i < 12; ++i) scans[i].T_world_sensor.translation().x() += 1000.0;
    PoseTracker tracker(refining());
    for (std::size_t i = 0; i < scans.size(); ++i) {
        if (i == 6) tracker.restart();
        const Eigen::Vector3d given = scans[i].T_world_sensor.translation();
        tracker.track(scans[i]);
        tracker.learn({});
        EXPECT_LT((scans[i].T_world_sensor.translation() - given).norm(), 0.01) << i;
    }
}

TEST(PoseTracker, BeginsAnewWithTheScanThatTheOdometryGaveUpAt) {
    auto scans = scans_of(14, false);
    for (std::size_t i = 3; i < 13; ++i) scans[i].points.clear();
    PoseTracker tracker({});
    for (Scan& scan : scans) {
        tracker.track(scan);
        EXPECT_EQ(tracker.begins_anew(), scan.index == 12) << scan.index;
        tracker.learn({});
    }
}

}  // namespace pose_tracker_test
}  // namespace dynamic_filter
