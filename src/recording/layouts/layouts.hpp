// SPDX-License-Identifier: MIT
/// The finders of the layouts, which registry.cpp lists. Each returns nothing for a folder of
/// another layout.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "recording/layout.hpp"

namespace dynamic_filter::io {

/// Where a layout is looked for.
struct Place {
    std::filesystem::path data;  ///< the folder
    std::filesystem::path top;   ///< the folder that the user gave: `data`, or one above it
    const OpenOptions& options;

    /// True if the user named the layout, so that the contents need not tell it from others.
    [[nodiscard]] bool is_named() const { return !options.layout.empty(); }
};

/// velodyne/*.bin with poses.txt, calib.txt, times.txt and labels/. Throws InputError if there is
/// a velodyne/ without scans, or if the layout is named.
std::optional<Layout> find_kitti(const Place& place);

/// pcd/*.pcd with points in the world frame, as in DynamicMap_Benchmark. Nothing for several scans
/// that all have the identity as VIEWPOINT, which is no pose. Throws InputError if the layout is
/// named.
std::optional<Layout> find_benchmark(const Place& place);

/// Scans in the folder or in one of the usual subfolders, with files beside them. Throws InputError
/// if there are none, because this layout is looked for last.
std::optional<Layout> find_folder(const Place& place);

/// The scans of a drive in several folders whose names are numbers, with the poses of all of them
/// beside these folders. Throws InputError if two scans have the same name.
std::optional<Layout> find_parts(const Place& place);

/// SEC_NSEC.pcd with SEC_NSEC.odom, a 4x4 matrix T_world_sensor each, as interactive_slam saves
/// them. Throws InputError if one file of a pair is missing.
std::optional<Layout> find_pairs(const Place& place);

/// A folder saved by GLIM: NNNNNN/ with data.txt (T_world_origin and the stamps of the frames) and
/// points_compact.bin. A scan is such a folder, for read_submap().
std::optional<Layout> find_glim(const Place& place);

/// Reads x y z, and the intensity if there is an intensities_compact.bin. Throws InputError.
Cloud read_submap(const std::filesystem::path& folder);

/// The dump of hdl_graph_slam: NNNNNN/ with cloud.pcd and `data`, which has the pose of the
/// keyframe as a 4x4 matrix below "estimate" or "odom", and its stamp. A scan is such a folder.
/// Throws InputError for a `data` without a pose.
std::optional<Layout> find_hdl(const Place& place);

/// MulRan: Ouster/NANOSECONDS.bin, here or in sensor_data/, and global_pose.csv. The folder may
/// also be Ouster itself. The file contains poses of the vehicle; the poses of the sensor follow
/// from the calibration of the data set. A scan without neighboring poses gets a non-finite pose.
/// Throws InputError if no scan gets a pose.
std::optional<Layout> find_mulran(const Place& place);

/// nuScenes: v1.0-*/ with its tables, samples/LIDAR_TOP and sweeps/LIDAR_TOP. Returns the scans of
/// one scene in the order of their times. If there are several scenes, the user appends the name of
/// one to the folder, as in DATA/scene-0061. The folder may also be one of those in it. Scans
/// between key frames that are not on the disk are left out. Key frames have ground truth if the
/// scene has boxes. Throws InputError with the names of the scenes if none is chosen, and if tables
/// contradict each other.
std::optional<Layout> find_nuscenes(const Place& place);
/// True for DATA/SCENE, which is no folder, but names a scene of the tables in DATA.
bool names_scene(const std::filesystem::path& data);

/// A raw drive of KITTI: velodyne_points/data/*.bin with timestamps.txt, and oxts/data/*.txt, from
/// which the poses are computed. The folder is that of the drive or its velodyne_points. Without
/// oxts, a note says so. A scan without an oxts file gets a non-finite pose. Throws InputError for
/// invalid rows, and if no scan gets a pose.
std::optional<Layout> find_kitti_raw(const Place& place);

/// A drive of KITTI-360 below data_3d_raw; data_poses and calibration are beside that folder. The
/// poses are those of the vehicle and exist for some scans only; between them they are interpolated
/// over up to 1 s. Otherwise like find_kitti_raw().
std::optional<Layout> find_kitti_360(const Place& place);

/// pcds/1.pcd, 2.pcd... with poses.txt, rows of "index stamp x y z qx qy qz qw", as in the samples
/// of Apollo. Throws InputError for invalid rows, and if no scan gets a pose.
std::optional<Layout> find_apollo(const Place& place);

/// Throws InputError if the scans are those of Argoverse 2, here or in logs below, which cannot be
/// read; the message says what to do.
void refuse_argoverse(const std::filesystem::path& data);

/// Chooses how the points of .bin files are read, by the contents of a few of them, and notes it if
/// they are not those of KITTI. Throws InputError if sizes or contents show that they have a layout
/// that is not known.
void choose_bin_points(Layout& layout);

/// Throws InputError with the names of the recordings.
[[noreturn]] void refuse_several(const std::filesystem::path& data, const Paths& recordings);

/// Throws InputError with their names if several subfolders are recordings (each with a velodyne/),
/// such as the sensors of HeLiMOS and the sequences of SemanticKITTI.
void refuse_several_recordings(const std::filesystem::path& data);

/// The only folder, at most four levels below `data`, that contains files of one of the kinds or a
/// drive. Empty if there is none. Throws InputError with their names if there are several.
std::optional<std::filesystem::path> find_below(const std::filesystem::path& data,
                                                const std::set<std::string>& kinds);

}  // namespace dynamic_filter::io
