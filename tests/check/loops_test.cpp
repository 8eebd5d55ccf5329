// SPDX-License-Identifier: MIT
#include "check/loops.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace loops_test {

/// There and back through the street; on the way back the poses are off to the side.
class Loops : public StreetRecording {
protected:
    test::Drive there_and_back() const {
        test::Drive drive = street(false);
        for (std::size_t i = kStreetScans; i-- > 0;) {
            Scan scan = street(false).scans[i];
            scan.index = drive.scans.size();
            scan.stamp = drive.scans.back().stamp + 0.2;
            drive.scans.push_back(std::move(scan));
            drive.truth.push_back(street(false).truth[i]);
        }
        return drive;
    }
};

TEST_F(Loops, ShowHowTheLaterPassageLies) {
    const test::Drive drive = there_and_back();
    auto poses = drive.truth;
    for (std::size_t i = kStreetScans; i < poses.size(); ++i) poses[i].translation().y() += 0.8;
    put(drive, poses);
    const std::vector<Motion> loops = find_loops(open());
    ASSERT_FALSE(loops.empty());
    for (const Motion& loop : loops) {
        const Pose expected = drive.truth[loop.from].inverse() * drive.truth[loop.to];
        const Pose off = expected.inverse() * loop.T_from_to;
        EXPECT_LT(off.translation().norm(), 0.15) << loop.from << " " << loop.to;
        EXPECT_LT(loop.from, loop.to);
        EXPECT_TRUE(loop.is_doubtful);
    }
}

TEST_F(Loops, AStraightWayHasNone) {
    put(street(false), street(false).truth);
    EXPECT_TRUE(find_loops(open()).empty());
}

}  // namespace loops_test
}  // namespace dynamic_filter::io
