// SPDX-License-Identifier: MIT
/// @file
/// Poses over time.
///
/// - Units: [m], [s].
/// - Frames: poses T_world_sensor; points in the sensor's.
/// - Shapes: arrays are parallel.
/// - Ownership: values; undo_motion() changes what it is given.
/// - Threads: pure functions; thread-safe.
/// - Errors: none.
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/io/cloud.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Where the sensor was, and when.
struct Trajectory {
    std::vector<double> stamps;  ///< [s], increasing
    std::vector<Pose> poses;     ///< T_world_sensor, parallel
};

/// Sorts by time; of equal stamps the first is kept.
void put_in_order(Trajectory& trajectory);

/// Between the two poses around `stamp` [s]: translation in a line, rotation by the shortest way.
/// Empty before the first and after the last (but for `beyond` [s], where the end's motion goes
/// on), and in gaps of more than `gap` [s]. Thread-safe.
std::optional<Pose> pose_at(const Trajectory& trajectory, double stamp, double gap = 1.0,
                            double beyond = 0.0);

/// When each point was measured, [s] from the scan's stamp [s], from the first field there is of
/// "t", "time", "timestamp", "offset_time", "time_offset", "timeOffset", "time_stamp" and "ts";
/// seconds, milliseconds, microseconds or nanoseconds, from the stamp or absolute. Empty if there
/// is none, if the times span less than 1 ms in any unit that makes them span up to a second, or if
/// they are absolute and more than 10 s from the stamp.
std::vector<float> point_times(const Cloud& cloud, double stamp);

/// The points as if all had been measured at the scan's stamp [s]: each is moved by what the sensor
/// moved since or until then. Points whose time lies more than 0.2 s beyond the trajectory, or in a
/// gap of it of more than 1 s, stay where they are; all do if the stamp itself does. Sensor frame
/// in, sensor frame out.
void undo_motion(Points& points, const std::vector<float>& times, double stamp,
                 const Trajectory& T_world_sensor);

}  // namespace dynamic_filter::io
