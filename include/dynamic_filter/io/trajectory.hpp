// SPDX-License-Identifier: MIT
/// @file
/// Poses over time, and motion compensation (deskewing) with them.
///
/// - Units: [m], [s].
/// - Frames: poses T_world_sensor; points in the sensor frame.
/// - Shapes: arrays are parallel.
/// - Ownership: values; undo_motion() changes its argument.
/// - Threads: pure functions; thread-safe.
/// - Errors: none.
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/io/cloud.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

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
/// Empty if there is no such field, if the times span less than 1 ms in every unit in which they
/// span at most one second, or if they are absolute and more than 10 s from the stamp.
std::vector<float> point_times(const Cloud& cloud, double stamp);

/// Motion compensation: moves each point to where it would be if it had been measured at the stamp
/// [s] of the scan. Points whose time lies more than 0.2 s outside the trajectory, or in one of its
/// gaps of more than 1 s, are not moved; if the stamp itself lies there, no point is moved. Input
/// and output are in the sensor frame.
void undo_motion(Points& points, const std::vector<float>& times, double stamp,
                 const Trajectory& T_world_sensor);

}  // namespace dynamic_filter::io
