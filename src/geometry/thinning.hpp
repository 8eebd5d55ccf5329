// SPDX-License-Identifier: MIT
/// Whether a voxel filter has thinned a scan before it came here.
#pragma once

#include <span>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// [m] About the side of the voxels in each of which a filter kept one point; 0 if the points lie
/// as the beams of a sensor do. The distance between neighboring returns grows with the range; that
/// of thinned points does not. Voxels below about 0.15 m or above 3 m are not noticed. `points` are
/// in the sensor frame. Thread-safe.
float thinning_of(std::span<const Point> points);

}  // namespace dynamic_filter
