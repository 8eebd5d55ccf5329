// SPDX-License-Identifier: MIT
/// @file
/// How well scans overlay if they were taken at given poses.
///
/// - Units: [m].
/// - Frames: poses T_world_sensor, points in the sensor's.
/// - Shapes: poses are parallel to scans.
/// - Threads: pure functions; thread-safe.
/// - Errors: none.
#pragma once

#include <span>

#include "dynamic_filter/odometry/config.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// [m] How far points lie off the surfaces of the map that the scans before make, and how rough
/// those are: the geometric mean of both together. The motion during scans is undone where the
/// times of their points are known. The scans' own poses are not looked at. 0 for fewer than two
/// scans.
double overlay_blur(std::span<const Scan> scans, std::span<const Pose> T_world_sensor,
                    const OdometryConfig& config);

}  // namespace dynamic_filter
