// SPDX-License-Identifier: MIT
#include "check/continuity.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace continuity_test {

class ContinuityOf : public StreetRecording {
protected:
    [[nodiscard]] std::vector<Alarm> breaks(const test::Drive& drive) const {
        put(drive, street(false).truth);
        return breaks_in(open());
    }
};

TEST_F(ContinuityOf, ASoundDriveHasNoBreak) { EXPECT_TRUE(breaks(street(false)).empty()); }

TEST_F(ContinuityOf, ScansInAnotherOrderBreakWhereTheyBegin) {
    test::Drive drive = street(false);
    std::rotate(drive.scans.begin(), drive.scans.begin() + 15, drive.scans.end());
    for (std::size_t i = 0; i < drive.scans.size(); ++i) {
        drive.scans[i].index = i;
        drive.scans[i].stamp = street(false).scans[i].stamp;
    }
    const std::vector<Alarm> found = breaks(drive);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].first, 14U);
    EXPECT_EQ(found[0].last, 15U);
    EXPECT_NE(found[0].what.find("the order of scans or poses is broken"), std::string::npos);
}

TEST_F(ContinuityOf, AScanThatWasCutOffIsNamed) {
    test::Drive drive = street(false);
    Points& points = drive.scans[12].points;
    points.resize(points.size() / 3);
    const std::vector<Alarm> found = breaks(drive);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].first, 12U);
    EXPECT_EQ(found[0].last, 12U);
    EXPECT_NE(found[0].what.find("a part of it is missing"), std::string::npos);
}

TEST(Continuity, OfNothingHasNoBreaks) {
    Continuity continuity;
    EXPECT_TRUE(continuity.breaks().empty());
    for (std::size_t i = 0; i < 30; ++i) continuity.add(i, gist_of({}, Pose::Identity()));
    EXPECT_TRUE(continuity.breaks().empty());
}

}  // namespace continuity_test
}  // namespace dynamic_filter::io
