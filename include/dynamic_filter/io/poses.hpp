// SPDX-License-Identifier: MIT
/// @file
/// Reads pose files.
///
/// - Units: [m]; stamps [s].
/// - Frames: T_world_sensor, if the file holds that (see pose_fix.hpp).
/// - Shapes: one entry per line.
/// - Ownership: values.
/// - Threads: thread-safe.
/// - Errors: InputError. For a line that is no rigid motion, it names the line and the likely
///   cause.
#pragma once

#include <filesystem>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Contents of a pose file.
struct PoseFile {
    std::vector<Pose> poses;  ///< T_world_sensor as written; rows of NaN (lost tracking) stay NaN
    std::vector<double> stamps;  ///< [s]; empty for KITTI rows and g2o
};

/// Reads a pose file. The format is recognized by the contents:
///
/// - KITTI: rows of 12 numbers, a row-major 3x4 matrix.
/// - TUM: rows of t x y z qx qy qz qw.
/// - CSV with a header: EuRoC (ns, x y z, qw qx qy qz), or other named columns.
/// - CSV of 13 columns without a header: MulRan (ns and a row-major 3x4 matrix).
/// - g2o: the vertices VERTEX_SE3:QUAT id x y z qx qy qz qw, ordered by id; other lines are
///   skipped.
///
/// Rotations within 1e-3 of orthogonal are made exact. Throws InputError for other rotations, for
/// reflections, for quaternions more than 1 % from unit length, for wrong numbers of columns, and
/// for two vertices with the same id.
PoseFile read_poses(const std::filesystem::path& file);

/// Reads a KITTI calib.txt: the 3x4 row after "Tr:" (velodyne to camera). Throws InputError.
Pose read_calib_tr(const std::filesystem::path& file);

/// Reads stamps [s], one per line. Throws InputError.
std::vector<double> read_times(const std::filesystem::path& file);

}  // namespace dynamic_filter::io
