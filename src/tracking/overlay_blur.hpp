// SPDX-License-Identifier: MIT
/// @file
/// Measures how well scans overlay at given poses.
///
/// - Units: [m].
/// - Frames: poses T_world_sensor, points in the sensor frame.
/// - Shapes: poses are parallel to scans.
/// - Threads: pure functions; thread-safe.
/// - Errors: none.
#pragma once

#include <span>

#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Blur [m] of the overlaid scans. Each point is compared with the surface at its place in the map
/// that the previous scans make; its value is the root of d^2 + v, with its distance d from the
/// surface and the variance v of the surface (its roughness). The blur is the geometric mean over
/// all points. If the times of the points are known, motion compensation is done. Poses inside the
/// scans are not used. Returns 0 for fewer than two scans.
double overlay_blur(std::span<const Scan> scans, std::span<const Pose> T_world_sensor,
                    const OdometryConfig& config);

}  // namespace dynamic_filter
