// SPDX-License-Identifier: MIT
/// @file
/// When a turning sensor measured each point, where only the points' directions tell.
///
/// - Units: [rad], [s].
/// - Frames: points in the sensor's, which turns about its z axis.
/// - Shapes: times are parallel to the points.
/// - Ownership: values.
/// - Threads: pure functions; thread-safe.
/// - Errors: none.
#pragma once

#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// How a sensor turns, seen from above.
struct Sweep {
    bool clockwise = false;  ///< which way it turns
    double seam = 0.0;       ///< [rad] azimuth at which a scan begins and ends
    double duration = 0.1;   ///< [s] of a turn
};

/// [s] from the middle of the sweep, so from -duration/2 to duration/2. What is not measured has
/// time 0.
std::vector<float> sweep_times(const Points& points, const Sweep& sweep);

}  // namespace dynamic_filter
