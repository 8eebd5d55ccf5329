// SPDX-License-Identifier: MIT
/// Reverting of static points that the visibility-based removal removed by mistake (Sec. III-B2).
#pragma once

#include <vector>

#include "dynamic_filter/settings.hpp"
#include "geometry/neighbor_grid.hpp"
#include "paper/window.hpp"

namespace dynamic_filter {

/// True if the point fits the static surface around it. The normal of its k nearest static
/// neighbors is computed without and with the point. The point fits if the norm of the difference
/// of both normals, independent of their signs, is less than dist_max. False if there are fewer
/// than three neighbors, or if they do not lie on a plane.
bool fits_static_map(const Point& point, const NeighborGrid& static_map,
                     const FrontEndConfig& config);

/// Map-based reverting (Sec. III-B2): dynamic points that fit the static submap become static
/// again. `static_map` holds the points that the removal left [map frame].
void revert_by_map(const Window& window, const NeighborGrid& static_map,
                   const FrontEndConfig& config, std::vector<Labels>& labels);

}  // namespace dynamic_filter
