// SPDX-License-Identifier: MIT
/// Layouts that are told by what is in the folder and that bring their scans' poses along.
#pragma once

#include <filesystem>
#include <optional>

#include "io/layout.hpp"

namespace dynamic_filter::io {

/// SEC_NSEC.pcd beside SEC_NSEC.odom, a 4x4 matrix T_world_sensor each, as interactive_slam saves
/// them. Empty if there is no .odom file; InputError for a half without its other half.
std::optional<Layout> find_pairs(const std::filesystem::path& data);

/// A folder that GLIM dumped: NNNNNN/ with data.txt (T_world_origin, the frames' stamps) and
/// points_compact.bin. A scan is such a folder, for read_submap. Empty if it is no such folder.
std::optional<Layout> find_glim(const std::filesystem::path& data);

/// x y z, and intensity if there is intensities_compact.bin. Throws InputError.
Cloud read_submap(const std::filesystem::path& folder);

/// MulRan: Ouster/NANOSECONDS.bin, here or in sensor_data/, and global_pose.csv. Its poses are the
/// vehicle's; those of the sensor follow from the data set's calibration. A scan without poses
/// around it gets one that is not finite. Empty if it is no such folder; InputError if no scan gets
/// a pose.
std::optional<Layout> find_mulran(const std::filesystem::path& data);

/// nuScenes: v1.0-*/ with its tables, samples/LIDAR_TOP and sweeps/LIDAR_TOP. One scene's scans in
/// the order of their times; of several scenes one is chosen by its name behind the folder's, as in
/// DATA/scene-0061. Empty if it is no such folder; InputError with the scenes' names if none is
/// chosen, and for tables that contradict each other.
std::optional<Layout> find_nuscenes(const std::filesystem::path& data);

/// Throws InputError with their names if the folders below are recordings (velodyne/ in each), as
/// are HeLiMOS's sensors and SemanticKITTI's sequences.
void refuse_several_recordings(const std::filesystem::path& data);

}  // namespace dynamic_filter::io
