// SPDX-License-Identifier: MIT
#include "check/watch.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "dynamic_filter/motion.hpp"
#include "support/random.hpp"
#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace watch_test {

/// A flat ground around the sensor, 40 m wide, with points every 0.25 m.
Points flat_ground() {
    Points points;
    for (int x = -80; x < 80; ++x) {
        for (int y = -80; y < 80; ++y) {
            points.emplace_back(0.25F * static_cast<float>(x) + 0.1F,
                                0.25F * static_cast<float>(y) + 0.1F, -1.8F);
        }
    }
    return points;
}

Labels labels_of(const Points& points, const std::function<bool(const Point&)>& is_gone) {
    Labels labels;
    for (const Point& p : points) labels.push_back(is_gone(p) ? Label::dynamic : Label::static_);
    return labels;
}

TEST(WatchScan, CountsTheGroundThatIsGone) {
    const Points points = flat_ground();
    const auto ahead = [](const Point& p) { return p.x() > 10.0F; };
    const ScanWatch watch = watch_scan(7, points, Pose::Identity(), labels_of(points, ahead));
    EXPECT_EQ(watch.scan, 7U);
    EXPECT_EQ(watch.points, points.size());
    EXPECT_EQ(watch.dynamic, points.size() / 4);
    EXPECT_EQ(watch.unknown, 0U);
    EXPECT_EQ(watch.ground, 80U * 80U);  // parts of 0.25 m2
    EXPECT_EQ(watch.ground_gone, 20U * 80U);
}

TEST(WatchScan, TheGroundIsThatOfTheWorld) {
    const Points points = flat_ground();
    Pose T_world_sensor = Pose::Identity();
    T_world_sensor.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()).toRotationMatrix();
    T_world_sensor.translation() = Eigen::Vector3d(1e5, -2e5, 300.0);
    const Points in_sensor =
        dynamic_filter::moved(points, Pose(T_world_sensor.linear().transpose()));
    const ScanWatch watch =
        watch_scan(0, in_sensor, T_world_sensor, Labels(points.size(), Label::dynamic));
    EXPECT_GT(watch.ground, 6000U);
    EXPECT_EQ(watch.ground_gone, watch.ground);
}

TEST(WatchScan, WhatStandsOrDrivesOnTheGroundIsNone) {
    Points points = flat_ground();
    const std::size_t on_ground = points.size();
    for (int x = 0; x < 20; ++x) {
        for (int y = 0; y < 8; ++y) {  // a roof of 5 x 2 m
            points.emplace_back(5.0F + 0.25F * static_cast<float>(x),
                                3.0F + 0.25F * static_cast<float>(y), -0.4F);
        }
        for (int z = 0; z < 40; ++z) {  // a wall
            points.emplace_back(-5.0F, 0.25F * static_cast<float>(x),
                                -1.75F + 0.1F * static_cast<float>(z));
        }
    }
    Labels labels(points.size(), Label::static_);
    std::fill(labels.begin() + static_cast<std::ptrdiff_t>(on_ground), labels.end(),
              Label::dynamic);
    const ScanWatch watch = watch_scan(0, points, Pose::Identity(), labels);
    EXPECT_GT(watch.dynamic, 900U);
    EXPECT_GT(watch.ground, 6000U);
    EXPECT_EQ(watch.ground_gone, 0U);
}

TEST(WatchScan, PointsThatAreNotMeasuredAreNotCounted) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const ScanWatch watch = watch_scan(0, {{0, 0, 0}, {nan, 1, 1}, {1, 2, 3}}, Pose::Identity(),
                                       {Label::unknown, Label::unknown, Label::unknown});
    EXPECT_EQ(watch.points, 1U);
    EXPECT_EQ(watch.unknown, 1U);
    EXPECT_EQ(watch.ground, 0U);
    EXPECT_EQ(watch_scan(0, {}, Pose::Identity(), {}).points, 0U);
}

std::vector<ScanWatch> sound_scans(std::size_t count) {
    std::vector<ScanWatch> scans;
    for (std::size_t i = 0; i < count; ++i) {
        scans.push_back({.scan = 2 * i,
                         .points = 1000,
                         .dynamic = 150,
                         .unknown = 50,
                         .ground = 300,
                         .ground_gone = 15});
    }
    return scans;
}

TEST(Alarms, OfASoundResultThereAreNone) {
    EXPECT_TRUE(alarms_of(sound_scans(100)).empty());
    EXPECT_TRUE(alarms_of({}).empty());
}

TEST(Alarms, NameTheScansThatLoseTheirGround) {
    std::vector<ScanWatch> scans = sound_scans(100);
    for (std::size_t i = 40; i < 46; ++i) scans[i].ground_gone = 60;
    scans[43].ground_gone = 150;
    const auto alarms = alarms_of(scans);
    ASSERT_EQ(alarms.size(), 1U);
    EXPECT_EQ(alarms[0].first, 80U);
    EXPECT_EQ(alarms[0].last, 90U);
    EXPECT_EQ(alarms[0].worst, 86U);
    EXPECT_EQ(alarms[0].what, "6 of 100 scans lose more than 15 % of their ground, up to 50 %");
}

TEST(Alarms, SingleScansAreNoReason) {
    std::vector<ScanWatch> scans = sound_scans(100);
    scans[10].ground_gone = scans[60].ground_gone = 300;
    EXPECT_TRUE(alarms_of(scans).empty());
}

TEST(Alarms, ScansThatShowLittleGroundAreTakenTogether) {
    std::vector<ScanWatch> scans = sound_scans(100);
    for (ScanWatch& s : scans) s.ground = 20, s.ground_gone = 1;
    scans[7].ground_gone = scans[8].ground_gone = 5;
    EXPECT_TRUE(alarms_of(scans).empty());
    for (std::size_t i = 50; i < 60; ++i) scans[i].ground_gone = 8;
    const auto alarms = alarms_of(scans);
    ASSERT_EQ(alarms.size(), 1U);
    EXPECT_EQ(alarms[0].first, 100U);
    EXPECT_EQ(alarms[0].last, 118U);
}

TEST(Alarms, MostPointsRemovedOrUnknown) {
    std::vector<ScanWatch> scans = sound_scans(100);
    for (ScanWatch& s : scans) s.dynamic = 450;
    ASSERT_EQ(alarms_of(scans).size(), 1U);
    EXPECT_EQ(alarms_of(scans)[0].what, "45 % of all points are removed");
    for (ScanWatch& s : scans) s.dynamic = 50, s.unknown = 500;
    ASSERT_EQ(alarms_of(scans).size(), 1U);
    EXPECT_EQ(alarms_of(scans)[0].what.find("50 % of all points are unknown"), 0U);
    scans.resize(9);
    EXPECT_TRUE(alarms_of(scans).empty()) << "of few scans much may stay unknown";
}

class ExplainAlarm : public StreetRecording {
protected:
    [[nodiscard]] Alarm explained(const std::vector<Pose>& poses, PosesFrom from) const {
        put(street(false), poses);
        return explain({.what = "bad", .worst = 15}, open(), from, {});
    }
};

TEST_F(ExplainAlarm, WrongPosesAreNamedAsSuch) {
    std::vector<Pose> poses = street(false).truth;
    test::Random random(1);
    for (Pose& pose : poses) pose = pose * random.pose(0.1, 0.01);
    const Alarm given = explained(poses, PosesFrom::given);
    EXPECT_NE(given.what.find("bad; there, scans blur by"), std::string::npos) << given.what;
    EXPECT_EQ(given.advice, "--refine on");
    EXPECT_EQ(explained(poses, PosesFrom::refined).advice, "--poses none");
    EXPECT_EQ(explained(poses, PosesFrom::found).advice, "give poses with --poses FILE");
}

TEST_F(ExplainAlarm, RightPosesAreNotBlamed) {
    const Alarm alarm = explained(street(false).truth, PosesFrom::given);
    EXPECT_NE(alarm.what.find("neighbouring scans fit the poses"), std::string::npos) << alarm.what;
    EXPECT_EQ(alarm.advice.find("--refine"), std::string::npos);
}

}  // namespace watch_test
}  // namespace dynamic_filter::io
