// SPDX-License-Identifier: MIT
/// @file
/// Computes when a rotating sensor measured each point, from the directions of the points. It is
/// used where a recording has no times of points.
///
/// - Units: [rad], [s].
/// - Frames: points in the frame of the sensor, which rotates about its z axis.
/// - Shapes: times are parallel to the points.
/// - Ownership: values.
/// - Threads: pure functions; thread-safe.
/// - Errors: none.
#pragma once

#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// The rotation of a sensor, seen from above.
struct Sweep {
    bool clockwise = false;  ///< direction of rotation
    double seam = 0.0;       ///< [rad] azimuth at which a scan begins and ends
    double duration = 0.1;   ///< [s] of one rotation
};

/// Times [s] relative to the middle of the sweep, from -duration/2 to duration/2. Points that are
/// not measured have time 0.
std::vector<float> sweep_times(const Points& points, const Sweep& sweep);

}  // namespace dynamic_filter
