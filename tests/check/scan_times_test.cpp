// SPDX-License-Identifier: MIT
#include "check/scan_times.hpp"

#include <gtest/gtest.h>

#include "geometry/scan_order.hpp"
#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace scan_times_test {

using ScanTimes = StreetRecording;

/// As the street looks to a sensor that turns while it measures one point after the other.
test::Drive turning_street() {
    constexpr double kRate = 0.6, kDuration = 0.2;  // [rad/s], [s]
    const auto turned = [](double time) {
        return Eigen::AngleAxisd(kRate * time, Eigen::Vector3d::UnitZ());
    };
    test::Drive drive = street(false);
    for (std::size_t i = 0; i < drive.scans.size(); ++i) {
        Scan& scan = drive.scans[i];
        const auto shares = order_shares(scan.points);
        for (std::size_t k = 0; k < scan.points.size(); ++k) {
            const double time = scan.stamp + kDuration * shares.at(k);
            scan.points[k] = (turned(time).inverse() * scan.points[k].cast<double>()).cast<float>();
        }
        drive.truth[i] = drive.truth[i] * turned(scan.stamp);
    }
    return drive;
}

TEST_F(ScanTimes, ThoseOfTheOrderOfPointsAreFoundAtExactPoses) {
    const test::Drive drive = turning_street();
    put(drive, drive.truth);
    const TimesChoice choice = choose_times(open(), {}, false);
    ASSERT_TRUE(choice.sweep);
    EXPECT_TRUE(choice.sweep->in_order);
    EXPECT_NEAR(choice.sweep->duration, 0.2, 1e-6);
    EXPECT_LT(choice.blur.undone, 0.99 * choice.blur.as_measured);
}

TEST_F(ScanTimes, SnapshotsStayAsTheyAre) {
    put(street(false), street(false).truth);
    for (const bool asks_more : {false, true}) {
        EXPECT_FALSE(choose_times(open(), {}, asks_more).sweep) << asks_more;
    }
}

TEST_F(ScanTimes, OfASensorAtRestNothingIsRead) {
    put(street(true), std::vector<Pose>(kStreetScans, Pose::Identity()));
    EXPECT_EQ(choose_times(open(), {}, false).blur.as_measured, 0.0);
}

TEST_F(ScanTimes, PossibleSweepsNeedAllDirections) {
    EXPECT_TRUE(possible_sweeps({{1, 0, 0}, {1, 0.1F, 0}}, 0.1).empty());
    const auto sweeps = possible_sweeps(street(true).scans.front().points, 0.1);
    ASSERT_EQ(sweeps.size(), 9U);
    EXPECT_TRUE(sweeps.front().in_order);
    EXPECT_FALSE(sweeps.back().in_order);
}

}  // namespace scan_times_test
}  // namespace dynamic_filter::io
