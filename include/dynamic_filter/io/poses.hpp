// SPDX-License-Identifier: MIT
/// @file
/// Pose files.
///
/// - Units: [m]; stamps [s].
/// - Frames: T_world_sensor, if that is what the file holds (see pose_fix.hpp).
/// - Shapes: an entry a line.
/// - Ownership: values.
/// - Threads: thread-safe.
/// - Errors: InputError; for a line that is no rigid motion it names the line and the likely cause.
#pragma once

#include <filesystem>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// What a pose file holds.
struct PoseFile {
    std::vector<Pose> poses;     ///< T_world_sensor as written; NaN rows stay NaN (lost tracking)
    std::vector<double> stamps;  ///< [s], empty for KITTI rows and g2o
};

/// Told apart by content: KITTI rows (12 numbers, row-major 3x4), TUM rows (t x y z qx qy qz qw),
/// CSV with a header (EuRoC: ns, x y z, qw qx qy qz; or named columns), CSV without one of 13
/// columns (MulRan: ns and a row-major 3x4), or g2o (the vertices VERTEX_SE3:QUAT id x y z qx qy qz
/// qw, ordered by id; all else is passed over). Rotations within 1e-3 of orthogonal are made exact;
/// others throw InputError, as do reflections, quaternions more than 1 % from unit length, wrong
/// column counts and two vertices of one id.
PoseFile read_poses(const std::filesystem::path& file);

/// KITTI calib.txt: the 3x4 row after "Tr:" (velodyne to camera). Throws InputError.
Pose read_calib_tr(const std::filesystem::path& file);

/// Stamps [s], one a line. Throws InputError.
std::vector<double> read_times(const std::filesystem::path& file);

}  // namespace dynamic_filter::io
