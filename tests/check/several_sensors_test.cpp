// SPDX-License-Identifier: MIT
#include "check/motion.hpp"
#include "dynamic_filter/check.hpp"
#include "recording/recording_parts.hpp"
#include "support/bag_recording.hpp"
#include "support/pillars.hpp"

namespace dynamic_filter::io {
namespace several_sensors_test {

class SeveralSensors : public BagFiles {
protected:
    /// Two sensors on one vehicle, 1 ms after each other; poses of the rear one are off by `error`.
    Recording two_sensors(const Pose& error = Pose::Identity()) {
        const Pose rear = moved(-1.5) * Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitZ());
        const auto base_at = [](double at) { return on_a_curve(10.0 * (at - kStart)); };
        for (std::size_t i = 0; i < 30; ++i) {
            const double second = stamp(i) + 0.001;
            put(pillars_seen_from(base_at(stamp(i))), "front", "/points", stamp(i));
            put(pillars_seen_from(base_at(second) * rear), "rear", "/points", second);
        }
        transform("base", "front", Pose::Identity(), kStart, "/tf_static");
        transform("base", "rear", error * rear, kStart, "/tf_static");
        for (double t = -0.1; t < 3.2; t += 0.01) {
            transform("odom", "base", base_at(kStart + t), kStart + t);
        }
        return opened();
    }
};

TEST_F(SeveralSensors, AreCheckedEachAlone) {
    const Recording recording = two_sensors();
    ASSERT_EQ(recording.size(), 60U);
    const Preflight preflight = check_recording(recording, Depth::quick);
    EXPECT_TRUE(preflight.findings.empty()) << preflight.findings.front().what;
    EXPECT_TRUE(preflight.unusable.empty());
    EXPECT_GT(preflight.overlays.front().share, 0.8);
}

TEST_F(SeveralSensors, AMountThatIsWrongIsFound) {
    const Pose error =
        Pose(Eigen::Translation3d(0, 0, 0) * Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitX()));
    EXPECT_FALSE(check_recording(two_sensors(error), Depth::quick).findings.empty());
}

TEST_F(SeveralSensors, PosesStay) {
    Recording recording = two_sensors();
    const Pose before = recording.info().T_world_sensor[7];
    Config config = preset("default");
    const app::ChosenMotion chosen = app::choose_motion(recording, config, {.refine = "auto"});
    EXPECT_TRUE(chosen.tracked.empty());
    EXPECT_EQ(recording.info().T_world_sensor[7].matrix(), before.matrix());
    EXPECT_FALSE(recording.info().sensor_at);
}

}  // namespace several_sensors_test
}  // namespace dynamic_filter::io
