// SPDX-License-Identifier: MIT
#include "dynamic_filter/check.hpp"

#include <algorithm>
#include <array>
#include <random>

#include "support/random.hpp"
#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace recorded_motion_test {

constexpr std::size_t kScans = kStreetScans;

/// Recordings of which some scans may be bad, with any poses.
class RecordedMotion : public StreetRecording {
protected:
    [[nodiscard]] MotionQuality quality(const std::vector<Pose>& poses) const {
        put(street(false), poses);
        return measure_motion(open(), {});
    }
};

TEST_F(RecordedMotion, ExactPosesAreNotBad) {
    const MotionQuality exact = quality(street(false).truth);
    EXPECT_FALSE(exact.has_bad_poses());
    EXPECT_GT(exact.found.as_measured, 0.0);
    EXPECT_EQ(exact.found.undone, 0.0);
    EXPECT_EQ(find_pose_mistake(open(), {}), "");
    ASSERT_EQ(exact.errors.size(), 4U);
    const std::array<std::size_t, 4> apart = {1, 5, 10, 20};
    for (std::size_t k = 0; k < apart.size(); ++k) {
        const auto [scans, way, shift, turn] = exact.errors[k];
        EXPECT_EQ(scans, apart[k]);
        EXPECT_NEAR(way, static_cast<double>(apart[k]), 0.1);
        EXPECT_LT(shift, 0.03);
        EXPECT_LT(turn, 0.002);
    }
}

TEST_F(RecordedMotion, NoisyPosesAreBad) {
    auto poses = street(false).truth;
    test::Random random(1);
    for (Pose& pose : poses) pose = pose * random.pose(0.1, 0.01);
    const MotionQuality noisy = quality(poses);
    EXPECT_TRUE(noisy.has_bad_poses());
    EXPECT_HAS(find_pose_mistake(open(), {}), "the poses jitter");
    EXPECT_GT(noisy.errors[0].shift, 0.05);
}

TEST_F(RecordedMotion, DriftingPosesAreBad) {
    auto poses = street(false).truth;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        poses[i] =
            poses[i] * Eigen::AngleAxisd(0.01 * static_cast<double>(i), Eigen::Vector3d::UnitZ());
    }
    const MotionQuality drifting = quality(poses);
    EXPECT_TRUE(drifting.has_bad_poses());
    EXPECT_HAS(find_pose_mistake(open(), {}), "the poses drift");
    EXPECT_NEAR(drifting.errors[3].turn, 0.2, 0.01);
    EXPECT_NEAR(drifting.errors[0].turn, 0.01, 0.001);
}

TEST_F(RecordedMotion, ScansThatCannotBeReadArePassedOver) {
    put(street(false), street(false).truth);
    data.put("velodyne/" + number(10) + ".bin", "");
    data.put("velodyne/" + number(14) + ".bin", "1234567");
    const Recording recording = open();
    EXPECT_FALSE(measure_motion(recording, {}).has_bad_poses());
    const auto tracked = track_scans(recording, {});
    ASSERT_EQ(tracked.size(), kScans);
    for (std::size_t i = 0; i < kScans; ++i) {
        EXPECT_EQ(tracked[i].has_value(), i != 10 && i != 14) << i;
        if (!tracked[i]) continue;
        const Pose& expected = street(false).truth[i];  // tied to the given poses
        EXPECT_LT((expected.inverse() * tracked[i]->T_world_sensor).translation().norm(), 0.1) << i;
    }
}

TEST_F(RecordedMotion, TrackingStopsWhenItIsTold) {
    put(street(false), {});
    std::size_t calls = 0;
    const auto tracked = track_scans(open(), {}, [&] { return ++calls < 4; });
    EXPECT_EQ(calls, 4U);
    ASSERT_EQ(tracked.size(), kScans);
    for (std::size_t i = 0; i < kScans; ++i) EXPECT_EQ(tracked[i].has_value(), i < 4) << i;
}

TEST_F(RecordedMotion, TheOrderOfPointsTellsTheirTimes) {
    put(street(true), {});
    const auto sweep = find_sweep(open(), {});
    ASSERT_TRUE(sweep);
    EXPECT_TRUE(sweep->in_order);
    EXPECT_NEAR(sweep->duration, 0.2, 1e-6);
}

TEST_F(RecordedMotion, WhichWayTheSensorTurnsIsFoundWithoutOrder) {
    test::Drive drive = street(true);
    for (Scan& scan : drive.scans) {
        std::shuffle(scan.points.begin(), scan.points.end(), std::mt19937(7));
    }
    put(drive, {});
    const auto sweep = find_sweep(open(), {});
    ASSERT_TRUE(sweep);
    EXPECT_FALSE(sweep->in_order);
    EXPECT_TRUE(sweep->clockwise);  // where it begins hardly shows on a straight way
    EXPECT_NEAR(sweep->duration, 0.2, 1e-6);
}

TEST_F(RecordedMotion, OfSnapshotsNoTurningIsFound) {
    put(street(false), {});
    EXPECT_FALSE(find_sweep(open(), {}));
}

/// People who walk let some rotation fit a few scans by chance, but not both halves of them.
TEST_F(RecordedMotion, OfFewSnapshotsOfACrowdNoTurningIsFound) {
    sim::SimulationOptions options;
    options.scene = "crowd";
    sim::Simulation simulation(options);
    test::Drive crowd;
    for (std::size_t i = 0; i < 12; ++i) {
        sim::SimulatedScan s = simulation.scan(i);
        crowd.truth.push_back(s.T_world_sensor);
        // The stamps are those of a faster sensor, as where 10 Hz are assumed.
        const double stamp = 0.1 * static_cast<double>(i);
        crowd.scans.push_back({std::move(s.points), Pose::Identity(), stamp, i, false});
    }
    put(crowd, {});
    EXPECT_FALSE(find_sweep(open(), {}));
}

TEST_F(RecordedMotion, OfHardlyAnyScansNothingIsSaid) {
    test::Drive one = street(false);
    one.scans.resize(1);
    one.truth.resize(1);
    put(one, one.truth);
    EXPECT_FALSE(find_sweep(open(), {}));
    const MotionQuality quality = measure_motion(open(), {});
    EXPECT_FALSE(quality.has_bad_poses());
    EXPECT_TRUE(quality.errors.empty());
}

TEST_F(RecordedMotion, WithoutPosesOnlyTheScansAreMeasured) {
    const MotionQuality without = quality({});
    EXPECT_FALSE(without.has_bad_poses());
    EXPECT_TRUE(without.errors.empty());
    EXPECT_EQ(without.given.least(), 0.0);
    EXPECT_GT(without.found.least(), 0.0);
    EXPECT_EQ(find_pose_mistake(open(), {}), "");
}

TEST(Blur, IsDistortedWhereItIsLessWithTheMotionUndone) {
    EXPECT_FALSE((Blur{0.1, 0.0}).is_distorted());
    EXPECT_FALSE((Blur{0.1, 0.1}).is_distorted());
    EXPECT_FALSE((Blur{0.05, 0.1}).is_distorted());
    EXPECT_TRUE((Blur{0.1, 0.08}).is_distorted());
    EXPECT_EQ((Blur{0.1, 0.0}).least(), 0.1);
    EXPECT_EQ((Blur{0.1, 0.08}).least(), 0.08);
    EXPECT_EQ((Blur{0.0, 0.08}).least(), 0.08);
    EXPECT_EQ(Blur{}.least(), 0.0);
}

}  // namespace recorded_motion_test
}  // namespace dynamic_filter::io
