// SPDX-License-Identifier: MIT
// Where the sensor is, from simulated scans alone.
#include "dynamic_filter/tracking.hpp"

#include <gtest/gtest.h>

#include <iostream>
#include <string>

#include "dynamic_filter/simulation.hpp"
#include "support/drive.hpp"

namespace dynamic_filter {
namespace accuracy_odometry_test {

using test::Drive;
using test::lost;
using test::track;

sim::SimulationOptions scene(const std::string& name, const std::string& sensor) {
    sim::SimulationOptions options;
    options.scene = name;
    options.sensor = sensor;
    options.seed = 5;
    return options;
}

Drive simulate(const sim::SimulationOptions& options, std::size_t first, std::size_t count) {
    sim::Simulation simulation(options);
    Drive drive;
    for (std::size_t i = first; i < first + count; ++i) {
        sim::SimulatedScan s = simulation.scan(i);
        drive.truth.push_back(s.T_world_sensor);
        drive.scans.push_back(
            {std::move(s.points), Pose::Identity(), s.stamp, i, false, std::move(s.times)});
    }
    return drive;
}

const Drive& street() {
    static const Drive drive = simulate(scene("street", "hdl32"), 0, 50);
    return drive;
}

const Drive& sweeping_street() {
    static const Drive drive = [] {
        auto options = scene("street", "hdl32");
        options.rate_hz = 5.0;  // a sweep distorts as much as at 10 m/s and 10 Hz
        options.sweep = true;
        return simulate(options, 20, 30);
    }();
    return drive;
}

void report(const std::string& what, double drift) {
    std::cerr << what << ": " << 100.0 * drift << " % off\n";
}

TEST(OdometryInScenes, FollowsACrowd) {
    const Drive drive = simulate(scene("crowd", "vlp16"), 0, 45);
    const auto tracked = track(drive.scans);
    EXPECT_EQ(lost(tracked), 0U);
    const double off = test::drift(drive, tracked);
    report("crowd", off);
    EXPECT_GE(off, 0.0);
    EXPECT_LT(off, 0.003);
}

TEST(OdometryInScenes, FollowsAStreet) {
    const auto tracked = track(street().scans);
    EXPECT_EQ(lost(tracked), 0U);
    const double off = test::drift(street(), tracked);
    report("street", off);
    EXPECT_GE(off, 0.0);
    EXPECT_LT(off, 0.003);
}

TEST(OdometryInScenes, FollowsAStreetThatADenserSensorSees) {
    const Drive drive = simulate(scene("street", "os64"), 100, 30);
    const auto tracked = track(drive.scans);
    EXPECT_EQ(lost(tracked), 0U);
    const double off = test::drift(drive, tracked);
    report("street, os64, from its middle on", off);
    EXPECT_GE(off, 0.0);
    EXPECT_LT(off, 0.003);
}

TEST(OdometryInScenes, GoesOnAfterAGap) {
    Drive drive = street();
    drive.scans.erase(drive.scans.begin() + 20, drive.scans.begin() + 27);
    drive.truth.erase(drive.truth.begin() + 20, drive.truth.begin() + 27);
    const auto tracked = track(drive.scans);
    EXPECT_EQ(lost(tracked), 0U);
    const double off = test::drift(drive, tracked);
    report("street with a gap", off);
    EXPECT_GE(off, 0.0);
    EXPECT_LT(off, 0.003);
}

TEST(OdometryInScenes, BeginsAtFullSpeed) {
    const Drive& all = sweeping_street();
    Drive late;
    late.scans.assign(all.scans.begin() + 12, all.scans.end());
    late.truth.assign(all.truth.begin() + 12, all.truth.end());
    const auto tracked = track(late.scans);
    EXPECT_EQ(lost(tracked), 0U);
    EXPECT_LT(test::off_between(late, tracked, 0, 1).head<3>().norm(), 0.05);
    EXPECT_LT(test::drift(late, tracked), 0.003);
}

// Its first scan alone hardly shows surfaces: the speed has to come from the scans that follow.
TEST(OdometryInScenes, AnIrregularPatternThatBeginsInMotionIsNotLost) {
    auto options = scene("street", "solid");
    options.seed = 22;
    const Drive drive = simulate(options, 0, 40);
    const auto tracked = track(drive.scans);
    EXPECT_EQ(lost(tracked), 0U);
    EXPECT_LT(test::off_between(drive, tracked, 20, 39).head<3>().norm(), 0.3);
}

TEST(OdometryInScenes, TimesOfPointsMakeSweepsBetter) {
    Drive drive = sweeping_street();
    const auto with_times = track(drive.scans);
    for (Scan& scan : drive.scans) scan.times.clear();
    const auto without = track(drive.scans);
    EXPECT_EQ(lost(with_times), 0U);
    const double off = test::drift(drive, with_times), off_without = test::drift(drive, without);
    report("sweeping street", off);
    report("... whose times are not known", off_without);
    EXPECT_GE(off, 0.0);
    EXPECT_LT(off, 0.003);
    EXPECT_LT(off, off_without);
}

}  // namespace accuracy_odometry_test
}  // namespace dynamic_filter
