// SPDX-License-Identifier: MIT
#include "check/rig_fit.hpp"

#include <numbers>

#include "geometry/pose.hpp"
#include "recording/recording_parts.hpp"
#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace rig_fit_test {

constexpr double kPeriod = 0.2;  // [s]

Pose rear_mount() { return placed({-1.2, 0.0, 0.1}, {0.0, 0.0, 180.0}); }

const test::Drive& drive_of(bool rear) {
    static std::array<std::optional<test::Drive>, 2> drives;
    auto& drive = drives[rear ? 1 : 0];
    if (drive) return *drive;
    sim::SimulationOptions options;
    options.scene = "street";
    options.sensor = "hdl32";
    options.rate_hz = 1.0 / kPeriod;
    if (rear) {
        options.mount = rear_mount();
        options.delay = 0.5 * kPeriod;
    }
    return drive.emplace(simulated_drive(options, 20));
}

/// A rig whose rear sensor is said to be at `place`, its stamps late by `late` [s].
Recording rig_with(const Pose& place, double late = 0.0) {
    RecordingParts parts;
    parts.rig = {{.name = "front", .T_vehicle_sensor = Pose::Identity()},
                 {.name = "rear", .T_vehicle_sensor = place}};
    Trajectory& vehicle = parts.rig[0].trajectory;
    for (std::size_t i = 0; i < kStreetScans; ++i) {
        vehicle.stamps.push_back(drive_of(false).scans[i].stamp);
        vehicle.poses.push_back(drive_of(false).truth[i]);
    }
    std::vector<const Scan*> scans;
    for (std::size_t i = 0; i + 1 < kStreetScans; ++i) {
        for (const bool rear : {false, true}) {
            const Scan& scan = drive_of(rear).scans[i];
            const double stamp = scan.stamp + (rear ? late : 0.0);
            const auto pose = pose_at(vehicle, stamp, 1.0, 1.0);
            parts.info.stamps.push_back(stamp);
            parts.info.T_world_sensor.push_back(rear ? *pose * place : *pose);
            parts.info.scan_files.emplace_back("scan");
            parts.sensors.push_back(rear ? 1 : 0);
            scans.push_back(&scan);
        }
    }
    parts.read_cloud = [scans](std::size_t i) {
        Cloud cloud;
        for (const char* name : {"x", "y", "z"}) add_field(cloud, name, FieldType::f32);
        const auto raw = std::as_bytes(std::span(scans[i]->points));
        cloud.data.assign(raw.begin(), raw.end());
        return cloud;
    };
    return Recording(std::move(parts));
}

Pose off(const Eigen::Vector3d& shift, const Eigen::Vector3d& turn) {
    Pose pose = rear_mount();
    pose.translation() += shift;
    pose.linear() = turned_by(turn) * pose.linear();
    return pose;
}

TEST(RigFit, ARightPlaceIsNoFinding) {
    const Recording recording = rig_with(rear_mount());
    const auto fits = fit_sensors(recording, {});
    ASSERT_EQ(fits.size(), 1U);
    ASSERT_TRUE(fits[0]);
    EXPECT_GE(fits[0]->fitting, 8U);
    EXPECT_LT(fits[0]->shift, 0.02);
    EXPECT_LT(fits[0]->turn, 0.2 * std::numbers::pi / 180.0);
    EXPECT_TRUE(misplaced_sensors(recording, {}).findings.empty());
}

TEST(RigFit, AWrongPlaceIsNamedWithTheRightOne) {
    for (const Pose& wrong :
         {off({0.0, 0.1, 0.0}, {0, 0, 0}), off({0, 0, 0}, {0, 0, 2}), off({0, 0, 0}, {0, 2, 0}),
          off({0, 0, 0}, {0, 0, 180}), off({0.05, 0, 0.1}, {1, 0, 90})}) {
        const auto findings = misplaced_sensors(rig_with(wrong), {}).findings;
        ASSERT_EQ(findings.size(), 1U);
        EXPECT_HAS(findings[0].what, "sensor 'rear' is not where the rig file says");
        EXPECT_HAS(findings[0].advice, "write at = [-1.");
        const auto fit = fit_sensors(rig_with(wrong), {})[0];
        const Twist error = log(rear_mount().inverse() * fit->T_vehicle_sensor);
        EXPECT_LT(error.head<3>().norm(), 0.03);
        EXPECT_LT(error.tail<3>().norm(), 0.2 * std::numbers::pi / 180.0);
    }
}

// The street is straight at first, so another place along it would explain the scans, too.
TEST(RigFit, AClockThatIsLateIsNamed) {
    const Recording recording = rig_with(rear_mount(), 0.05);
    const auto fit = fit_sensors(recording, {})[0];
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->delay, -0.05, 0.01);
    const auto findings = misplaced_sensors(recording, {}).findings;
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_HAS(findings[0].advice, "clock = -0.05");
}

TEST(RigFit, AWrongPlaceIsFoundAlsoIfEachSensorHasPosesOfItsOwn) {
    RecordingParts parts = rig_with(off({0, 0.3, 0}, {0, 0, 0})).parts();
    for (std::size_t i = 0; i < parts.sensors.size(); ++i) {
        if (parts.sensors[i] == 1) parts.info.T_world_sensor[i] = drive_of(true).truth[i / 2];
    }
    const auto findings = misplaced_sensors(Recording(std::move(parts)), {}).findings;
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_HAS(findings[0].advice, "write at = [-1.20");
}

TEST(RigFit, ASensorThatCannotBeComparedIsNamed) {
    const Recording recording = chosen_scans(rig_with(rear_mount()), {0, 1, 2, 3});
    const RigFindings found = misplaced_sensors(recording, {});
    EXPECT_TRUE(found.findings.empty());
    ASSERT_EQ(found.notes.size(), 1U);
    EXPECT_HAS(found.notes[0], "sensor 'rear' sees too little");
}

TEST(RigFit, SensorsWithoutPlacesAreNotLookedAt) {
    RecordingParts parts = rig_with(off({0, 1, 0}, {0, 0, 0})).parts();
    parts.rig[1].T_vehicle_sensor.reset();
    EXPECT_TRUE(misplaced_sensors(Recording(std::move(parts)), {}).findings.empty());
}

}  // namespace rig_fit_test
}  // namespace dynamic_filter::io
