// SPDX-License-Identifier: MIT
/// Layouts that are told by what is in the folder and that bring their scans' poses along.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

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

/// A raw drive of KITTI: velodyne_points/data/*.bin with timestamps.txt, and oxts/data/*.txt, from
/// which the poses come; the folder itself or its velodyne_points. Without oxts a note says so.
/// A scan without its file there has a pose that is not finite. Empty if it is no such folder;
/// InputError for rows that are none, and if no scan gets a pose.
std::optional<Layout> find_kitti_raw(const std::filesystem::path& data, const OpenOptions& options);

/// A drive of KITTI-360, below data_3d_raw; data_poses and calibration lie beside that. Poses are
/// the vehicle's, of some scans only: between these they are interpolated, up to a second.
/// Otherwise as find_kitti_raw.
std::optional<Layout> find_kitti_360(const std::filesystem::path& data, const OpenOptions& options);

/// pcds/1.pcd, 2.pcd... with poses.txt, rows "index stamp x y z qx qy qz qw", as Apollo's samples
/// have them. Empty if it is no such folder; InputError for rows that are none, and if no scan gets
/// a pose.
std::optional<Layout> find_apollo(const std::filesystem::path& data, const OpenOptions& options);

/// Throws InputError if the scans are Argoverse 2's, which are not read; it says what to do.
void refuse_argoverse(const std::filesystem::path& data);

/// Throws InputError with the recordings' names.
[[noreturn]] void refuse_several(const std::filesystem::path& data, const Paths& recordings);

/// Throws InputError with their names if several of the folders below are recordings (velodyne/ in
/// each), as are HeLiMOS's sensors and SemanticKITTI's sequences.
void refuse_several_recordings(const std::filesystem::path& data);

/// The only folder, at most two below `data`, that holds files of one of the kinds or a drive.
/// Empty if there is none; InputError with their names if there are several.
std::optional<std::filesystem::path> find_below(const std::filesystem::path& data,
                                                const std::set<std::string>& kinds);

}  // namespace dynamic_filter::io
