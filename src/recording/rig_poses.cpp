// SPDX-License-Identifier: MIT
#include "recording/rig_poses.hpp"

#include <algorithm>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/matching.hpp"
#include "recording/poses_at_scans.hpp"

namespace dynamic_filter::io {
namespace {

/// The entries before and after a stamp; the first or last two beyond the ends.
std::pair<std::size_t, std::size_t> around(const std::vector<double>& stamps, double stamp) {
    if (stamps.size() < 2) return {0, 0};
    const auto next = std::upper_bound(stamps.begin(), stamps.end(), stamp) - stamps.begin();
    const auto after =
        std::clamp<std::size_t>(static_cast<std::size_t>(next), 1, stamps.size() - 1);
    return {after - 1, after};
}

}  // namespace

Trajectory read_vehicle_poses(const std::filesystem::path& file, PoseFix fix,
                              const std::vector<double>& stamps, std::vector<std::string>& notes) {
    const PoseFile read = read_pose_file(file, fix);
    if (read.stamps.empty()) {
        throw InputError(file, "",
                         "has no stamps; poses of a vehicle with several sensors need them (TUM: "
                         "rows of t x y z qx qy qz qw)");
    }
    const double unit = unit_between(read.stamps, stamps);
    Trajectory vehicle = without_lost(read.stamps, read.poses);
    for (double& stamp : vehicle.stamps) stamp *= unit;
    for (Pose& pose : vehicle.poses) pose = fixed(fix, pose);
    notes.insert(notes.end(), read.notes.begin(), read.notes.end());
    return vehicle;
}

Trajectory known_poses(const Info& info, double clock) {
    Trajectory known = info.trajectory.stamps.empty()
                           ? without_lost(info.stamps, info.T_world_sensor)
                           : without_lost(info.trajectory.stamps, info.trajectory.poses);
    for (double& stamp : known.stamps) stamp += clock;
    return known;
}

Trajectory moved_by(Trajectory trajectory, const Pose& T) {
    for (Pose& pose : trajectory.poses) pose = pose * T;
    return trajectory;
}

std::vector<Pose> poses_near(const Trajectory& trajectory, const std::vector<double>& stamps) {
    const double apart = limits_for(trajectory.stamps).apart;
    std::vector<Pose> poses;
    for (const double stamp : stamps) {
        poses.push_back(pose_at(trajectory, stamp, apart, 0.5 * apart).value_or(lost_pose()));
    }
    return poses;
}

bool knows_places(const RecordingParts& parts) {
    return !parts.rig.empty() &&
           std::all_of(parts.rig.begin(), parts.rig.end(),
                       [](const RigSensor& sensor) { return sensor.T_vehicle_sensor.has_value(); });
}

std::vector<std::optional<Tracked>> tracked_for_all(
    const Recording& recording, const std::vector<std::optional<Tracked>>& of_first) {
    const RecordingParts& parts = recording.parts();
    const std::vector<double>& stamps = parts.info.stamps;
    const std::size_t first = *std::min_element(parts.sensors.begin(), parts.sensors.end());
    const Pose T_first_vehicle = parts.rig[first].T_vehicle_sensor->inverse();
    std::vector<std::optional<Tracked>> all(recording.size());
    Trajectory vehicle;
    std::vector<TrackStatus> status;  // parallel
    for (std::size_t i = 0, k = 0; i < recording.size(); ++i) {
        if (parts.sensors[i] != first) continue;
        all[i] = of_first[k++];
        if (!all[i]) continue;
        vehicle.stamps.push_back(stamps[i]);
        vehicle.poses.push_back(all[i]->T_world_sensor * T_first_vehicle);
        status.push_back(all[i]->status);
    }
    const std::vector<Pose> T_world_vehicle = poses_near(vehicle, stamps);
    for (std::size_t i = 0; i < recording.size(); ++i) {
        if (parts.sensors[i] == first || !T_world_vehicle[i].matrix().allFinite()) continue;
        const Pose& T_vehicle_sensor = *parts.rig[parts.sensors[i]].T_vehicle_sensor;
        const auto [before, after] = around(vehicle.stamps, stamps[i]);
        Tracked& tracked = all[i].emplace();
        tracked.T_world_sensor = T_world_vehicle[i] * T_vehicle_sensor;
        tracked.status = status[before];
        if (before == after) continue;
        const Pose from = vehicle.poses[before] * T_vehicle_sensor;
        const Pose to = vehicle.poses[after] * T_vehicle_sensor;
        tracked.velocity =
            log(from.inverse() * to) / (vehicle.stamps[after] - vehicle.stamps[before]);
    }
    return all;
}

Recording with_vehicle_poses(const Recording& recording) {
    RecordingParts parts = recording.parts();
    for (std::size_t i = 0; i < parts.info.T_world_sensor.size(); ++i) {
        Pose& pose = parts.info.T_world_sensor[i];
        pose = pose * parts.rig[parts.sensors[i]].T_vehicle_sensor->inverse();
    }
    return Recording(std::move(parts));
}

}  // namespace dynamic_filter::io
