// SPDX-License-Identifier: MIT
#include "check/scan_times.hpp"

#include <gtest/gtest.h>

#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace scan_times_test {

using ScanTimes = StreetRecording;

/// On a straight way, motion within scans shifts all alike, so they need not become sharper.
TEST_F(ScanTimes, AreJudgedAtTheGivenPoses) {
    put(street(true), street(true).truth);
    const TimesChoice choice = choose_times(open(), {}, true);
    EXPECT_GT(choice.blur.undone, 0.0);
    EXPECT_LT(choice.blur.undone, 1.01 * choice.blur.as_measured);
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
