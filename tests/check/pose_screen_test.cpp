// SPDX-License-Identifier: MIT
#include "check/pose_screen.hpp"

#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace pose_screen_test {

using PoseScreen = StreetRecording;

/// The true poses, each changed by its number.
template <class Change>
std::vector<Pose> changed(const Change& change) {
    std::vector<Pose> poses = street(false).truth;
    for (std::size_t i = 0; i < poses.size(); ++i) change(poses[i], static_cast<double>(i));
    return poses;
}

TEST_F(PoseScreen, TruePosesAreExact) {
    put(street(false), street(false).truth);
    EXPECT_TRUE(poses_are_exact(open(), {}));
}

/// A hall full of people, with 16 beams; the poses are exact, or have noise of 3 cm.
test::Drive crowd(double noise) {
    sim::SimulationOptions options;
    options.scene = "crowd";
    options.pedestrians = 150;
    options.seed = 37;
    options.rate_hz = 2.5;
    options.pose_noise_m = noise;
    return simulated_drive(options, 0);
}

TEST_F(PoseScreen, TruePosesAreExactAmongPeopleWhoMoveThemselves) {
    const test::Drive drive = crowd(0.0);
    put(drive, drive.truth);
    EXPECT_TRUE(poses_are_exact(open(), {}));
}

TEST_F(PoseScreen, NoisyPosesAmongPeopleAreNot) {
    const test::Drive drive = crowd(0.03);
    put(drive, drive.truth);
    EXPECT_FALSE(poses_are_exact(open(), {}));
}

TEST_F(PoseScreen, PosesThatDriftAreNot) {
    put(street(false), changed([](Pose& pose, double i) { pose.translation().y() += 0.01 * i; }));
    EXPECT_FALSE(poses_are_exact(open(), {}));
}

TEST_F(PoseScreen, PosesInOtherUnitsAreNot) {
    put(street(false), changed([](Pose& pose, double) { pose.translation() *= 1.1; }));
    EXPECT_FALSE(poses_are_exact(open(), {}));
}

TEST_F(PoseScreen, PosesThatRestWhileTheSensorMovesAreNot) {
    put(street(false), changed([](Pose& pose, double) { pose.setIdentity(); }));
    EXPECT_FALSE(poses_are_exact(open(), {}));
}

TEST_F(PoseScreen, PosesThatAreTurnedAreNot) {
    put(street(false), changed([](Pose& pose, double i) {
            pose.rotate(Eigen::AngleAxisd(0.001 * i, Eigen::Vector3d::UnitZ()));
        }));
    EXPECT_FALSE(poses_are_exact(open(), {}));
}

TEST_F(PoseScreen, ScansThatCannotBeReadTellNothing) {
    put(street(false), street(false).truth);
    const Recording recording = open();
    std::filesystem::remove_all(data / "velodyne");
    EXPECT_FALSE(poses_are_exact(recording, {}));
}

}  // namespace pose_screen_test
}  // namespace dynamic_filter::io
