// SPDX-License-Identifier: MIT
#include "recording/rig_poses.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "geometry/pose.hpp"

namespace dynamic_filter::io {
namespace rig_poses_test {

/// The vehicle drives along a circle of 20 m at 5 m/s.
Pose vehicle_at(double stamp) {
    const double angle = 5.0 / 20.0 * stamp;
    Pose pose = Pose::Identity();
    pose.linear() = turned_by({0.0, 0.0, angle * 180.0 / std::numbers::pi});
    pose.translation() << 20.0 * std::sin(angle), 20.0 * (1.0 - std::cos(angle)), 0.0;
    return pose;
}

Recording two_sensors() {
    RecordingParts parts;
    Pose rear = Pose::Identity();
    rear.translation() << -2.0, 0.5, 1.0;
    rear.linear() = turned_by({0.0, 20.0, 180.0});
    parts.rig = {{.name = "front", .T_vehicle_sensor = Pose(Eigen::Translation3d(1, 0, 1))},
                 {.name = "rear", .T_vehicle_sensor = rear}};
    for (std::size_t i = 0; i < 20; ++i) {
        parts.info.stamps.push_back(0.05 * static_cast<double>(i));
        parts.info.scan_files.emplace_back("scan");
        parts.sensors.push_back(i % 2);
    }
    return Recording(std::move(parts));
}

TEST(TrackedForAll, PlacesTheOtherSensorsWhereTheVehicleHasThem) {
    const Recording recording = two_sensors();
    const auto& [info, sensors, rig] =
        std::tie(recording.info(), recording.parts().sensors, recording.parts().rig);
    std::vector<std::optional<Tracked>> of_first;
    for (std::size_t i = 0; i < 20; i += 2) {
        of_first.emplace_back().emplace().T_world_sensor =
            vehicle_at(info.stamps[i]) * *rig[0].T_vehicle_sensor;
    }
    of_first[1]->status = TrackStatus::weak;
    const auto all = tracked_for_all(recording, of_first);
    for (std::size_t i = 0; i < 20; ++i) {
        ASSERT_TRUE(all[i]) << i;
        const auto& T = *rig[sensors[i]].T_vehicle_sensor;
        const Twist off = log((vehicle_at(info.stamps[i]) * T).inverse() * all[i]->T_world_sensor);
        EXPECT_LT(off.norm(), 0.01) << i;
        if (sensors[i] == 0) continue;
        const Twist moves = log((vehicle_at(info.stamps[i]) * T).inverse() *
                                (vehicle_at(info.stamps[i] + 0.01) * T)) /
                            0.01;
        EXPECT_LT((all[i]->velocity - moves).norm(), 0.1) << i;
    }
    EXPECT_EQ(all[3]->status, TrackStatus::weak);
    EXPECT_EQ(all[5]->status, TrackStatus::good);
}

TEST(TrackedForAll, NothingIsMadeUpWhereTheFirstSensorWasLost) {
    const Recording recording = two_sensors();
    std::vector<std::optional<Tracked>> of_first(10);
    of_first[0].emplace();
    of_first[1].emplace();
    const auto all = tracked_for_all(recording, of_first);
    EXPECT_TRUE(all[1]);
    EXPECT_TRUE(all[3]);  // half a step after the last pose
    EXPECT_FALSE(all[11]);
    EXPECT_FALSE(all[12]);
}

TEST(WithVehiclePoses, AreThoseOfTheVehicle) {
    RecordingParts parts = two_sensors().parts();
    for (std::size_t i = 0; i < 20; ++i) {
        parts.info.T_world_sensor.push_back(vehicle_at(parts.info.stamps[i]) *
                                            *parts.rig[parts.sensors[i]].T_vehicle_sensor);
    }
    const Recording recording = with_vehicle_poses(Recording(std::move(parts)));
    for (std::size_t i = 0; i < 20; ++i) {
        EXPECT_TRUE(recording.info().T_world_sensor[i].isApprox(
            vehicle_at(recording.info().stamps[i]), 1e-9));
    }
}

}  // namespace rig_poses_test
}  // namespace dynamic_filter::io
