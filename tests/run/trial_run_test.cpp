// SPDX-License-Identifier: MIT
#include "run/trial_run.hpp"

#include "dynamic_filter/settings.hpp"
#include "support/random.hpp"
#include "support/street_recording.hpp"

namespace dynamic_filter::app {
namespace trial_run_test {

class TrialRun : public io::StreetRecording {};

TEST_F(TrialRun, OfASoundRecordingItFindsNothing) {
    put(io::street(false), io::street(false).truth);
    EXPECT_TRUE(try_run(open(), preset("default")).empty());
}

TEST_F(TrialRun, WrongHeightsRemoveTheGround) {
    std::vector<Pose> poses = io::street(false).truth;
    test::Random random(2);
    for (Pose& pose : poses) pose.translation().z() += random.uniform(-0.4, 0.4);
    put(io::street(false), poses);
    const auto alarms = try_run(open(), preset("default"));
    ASSERT_EQ(alarms.size(), 1U);
    EXPECT_NE(alarms[0].what.find("of their ground"), std::string::npos) << alarms[0].what;
    EXPECT_EQ(alarms[0].advice, "--refine on");
}

}  // namespace trial_run_test
}  // namespace dynamic_filter::app
