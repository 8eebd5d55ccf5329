// SPDX-License-Identifier: MIT
#include "check/track_scans.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace track_scans_test {

using TrackScans = StreetRecording;

/// [m] mean distance from the true positions.
double mean_error(const TrackedScans& tracked, const Pose& T_truth_world) {
    double sum = 0.0;
    for (std::size_t i = 0; i < tracked.size(); ++i) {
        const Pose found = T_truth_world * tracked[i]->T_world_sensor;
        sum += (found.translation() - street(false).truth[i].translation()).norm();
    }
    return sum / static_cast<double>(tracked.size());
}

TEST_F(TrackScans, WithoutPosesTheWorldIsTheFirstScan) {
    put(street(false), {});
    const TrackedScans tracked = bind_poses(open(), follow(open(), {}, {}), false);
    EXPECT_TRUE(tracked.front()->T_world_sensor.isApprox(Pose::Identity(), 1e-6));
    EXPECT_LT(mean_error(tracked, street(false).truth.front()), 0.1);
}

TEST_F(TrackScans, IsTiedToPosesThatAreKnownNowAndThen) {
    auto poses = street(false).truth;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (i % 10 != 0) poses[i].matrix().setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    put(street(false), poses);
    const TrackedScans tracked = bind_poses(open(), follow(open(), {}, {}), true);
    ASSERT_TRUE(tracked[5]);
    EXPECT_LT(mean_error(tracked, Pose::Identity()), 0.1);
}

}  // namespace track_scans_test
}  // namespace dynamic_filter::io
