// SPDX-License-Identifier: MIT
/// @file
/// Reads pose files, corrects common mistakes in poses, and interpolates poses over time, also for
/// motion compensation (deskewing).
///
/// - Units: [m], except PoseFix::millimetres; stamps [s].
/// - Frames: T_world_sensor, if the file holds that; see each correction. Points are in the sensor
///   frame.
/// - Shapes: one entry per line of a file; arrays are parallel.
/// - Ownership: values; undo_motion() changes its argument.
/// - Threads: pure functions; thread-safe.
/// - Errors: InputError of the functions that read. For a line that is no rigid motion, it names
///   the line and the likely cause.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Corrections of poses: what the poses of the file really are.
enum class PoseFix {
    none,         ///< they are T_world_sensor [m], so nothing is corrected
    inverse,      ///< they are T_sensor_world
    camera,       ///< they are poses of a camera (x right, y down, z forward), not of the LiDAR
    lidar,        ///< they are poses of the LiDAR, but were read as those of a camera
    wxyz,         ///< quaternions are w x y z, but were read as x y z w
    xyzw,         ///< quaternions are x y z w, but were read as w x y z
    millimetres,  ///< translations are in millimetres
    centimetres,  ///< translations are in centimetres
    feet,         ///< translations are in feet
    transpose,  ///< rotations are R_sensor_world, and turn in the wrong sense; positions are right
    mirror,     ///< y points to the right, and yaw turns clockwise, as in left-handed simulators
    ned,        ///< world and vehicle have x ahead, y to the right, z down
    relative,   ///< each is the motion since the row before it; see chained()
};

/// All corrections except `none`, in the order in which --pose-fix lists them.
const std::vector<PoseFix>& pose_fixes();
/// Name of a correction, as --pose-fix takes it.
std::string to_string(PoseFix fix);

/// Corrects a pose that was read without the correction; returns T_world_sensor. `relative` needs
/// all poses, so it changes nothing here.
Pose fixed(PoseFix fix, const Pose& pose);

/// The poses that follow from motions, each of which is T_last_sensor and the first one
/// T_world_sensor. What is not finite counts as no motion, and stays as it is.
std::vector<Pose> chained(std::vector<Pose> motions);

/// Contents of a pose file.
struct PoseFile {
    std::vector<Pose> poses;  ///< T_world_sensor as written; rows of NaN (lost tracking) stay NaN
    std::vector<double>
        stamps;  ///< [s], not decreasing; empty for matrices without a stamp, and g2o
    std::vector<std::string> notes;  ///< what was done to the rows, such as sorting; for the user
};

/// Reads a pose file, UTF-8 or UTF-16. The format is recognized by the contents. Numbers have
/// blanks or commas between them:
///
/// - KITTI: rows of 12 numbers, a row-major 3x4 matrix, or of 16, a 4x4 matrix; or either after a
///   stamp [s] or after an index that counts the rows.
/// - 4x4 matrices below each other, in lines of four numbers.
/// - TUM: rows of t x y z qx qy qz qw.
/// - Rows below a line that names their columns: EuRoC (ns, x y z, qw qx qy qz), `rostopic echo
/// -p`,
///   or others.
/// - MulRan: 13 numbers with commas, whole ns and a row-major 3x4 matrix.
/// - g2o: the vertices VERTEX_SE3:QUAT id x y z qx qy qz qw, ordered by id; other lines are
///   skipped.
///
/// Rows that are not in the order of time are sorted, if the path gets no longer by that. Rotations
/// within 1e-3 of orthogonal are made exact. Throws InputError for other rotations, for
/// reflections, for quaternions more than 1 % from unit length, for wrong numbers of columns, for
/// quaternions whose order is not known, and for two vertices with the same id.
PoseFile read_poses(const std::filesystem::path& file);

/// Reads a KITTI calib.txt: the 3x4 row after "Tr:", "Tr_velo_to_cam:" or "Tr_velo_cam:" (velodyne
/// to camera); the latter two with the rotation after "R0_rect:" or "R_rect", if there is one.
/// Throws InputError.
Pose read_calib_tr(const std::filesystem::path& file);

/// Reads stamps [s], one per line. Throws InputError.
std::vector<double> read_times(const std::filesystem::path& file);

/// Poses of the sensor and their times.
struct Trajectory {
    std::vector<double> stamps;  ///< [s], increasing
    std::vector<Pose> poses;     ///< T_world_sensor, parallel to `stamps`
};

/// Sorts the poses by time; of poses with equal stamps, the first one is kept.
void put_in_order(Trajectory& trajectory);

/// Interpolates between the two poses around `stamp` [s]: the translation linearly, the rotation
/// along the shortest path. For up to `beyond` [s] before the first and after the last pose, it
/// extrapolates the motion there. Empty farther out, and in gaps longer than `gap` [s].
/// Thread-safe.
std::optional<Pose> pose_at(const Trajectory& trajectory, double stamp, double gap = 1.0,
                            double beyond = 0.0);

/// Times at which the points were measured, [s] relative to the stamp [s] of the scan. They are
/// read from the first of these fields that exists: "t", "time", "timestamp", "offset_time",
/// "time_offset", "timeOffset", "time_stamp", "ts". The unit is recognized (seconds, milliseconds,
/// microseconds or nanoseconds), and also whether times are absolute or relative to the stamp.
/// Absolute times that are more than 10 s from the stamp are of another clock, and count from the
/// first of them. Empty if there is no such field, or if the times span less than 1 ms in every
/// unit in which they span at most one second.
std::vector<float> point_times(const Cloud& cloud, double stamp);

/// Motion compensation: moves each point to where it would be if it had been measured at the stamp
/// [s] of the scan. Points whose time lies more than 0.2 s outside the trajectory, or in one of its
/// gaps of more than 1 s, are not moved; if the stamp itself lies there, no point is moved. Input
/// and output are in the sensor frame.
void undo_motion(Points& points, const std::vector<float>& times, double stamp,
                 const Trajectory& T_world_sensor);

}  // namespace dynamic_filter::io
