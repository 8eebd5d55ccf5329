// SPDX-License-Identifier: MIT
/// Poses of a vehicle, and of the sensors on it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/recording.hpp"
#include "recording/recording_parts.hpp"

namespace dynamic_filter::io {

/// The poses of a file, corrected, in the unit of `stamps` [s], which are those of the scans. Adds
/// the notes of the file. Throws InputError if it has no stamps.
Trajectory read_vehicle_poses(const std::filesystem::path& file, PoseFix fix,
                              const std::vector<double>& stamps, std::vector<std::string>& notes);

/// Those of a recording that are known, with `clock` [s] added to the stamps.
Trajectory known_poses(const Info& info, double clock);

Trajectory moved_by(Trajectory trajectory, const Pose& T);

/// The poses at these stamps. For a step between two poses before the first and after the last one,
/// the motion goes on; farther out, and where poses are sparse, they are lost_pose().
std::vector<Pose> poses_near(const Trajectory& trajectory, const std::vector<double>& stamps);

/// True if it is known where each sensor of the recording is on the vehicle.
bool knows_places(const RecordingParts& parts);

/// Where the scans of all sensors are if those of the first one are at `of_first`, parallel to the
/// scans of by_sensor(recording).front(). The places of the sensors must be known.
std::vector<std::optional<Tracked>> tracked_for_all(
    const Recording& recording, const std::vector<std::optional<Tracked>>& of_first);

/// The same recording with poses of the vehicle in Info::T_world_sensor, to write them.
Recording with_vehicle_poses(const Recording& recording);

}  // namespace dynamic_filter::io
