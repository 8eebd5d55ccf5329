// SPDX-License-Identifier: MIT
/// Reverting of points that visibility removed although they are static (Sec. III-B2).
#pragma once

#include <vector>

#include "dynamic_filter/geometry/neighbor_grid.hpp"
#include "dynamic_filter/submaps_observe/config.hpp"
#include "dynamic_filter/submaps_observe/window.hpp"

namespace dynamic_filter {

/// True if the point fits the static surface around it: the normal of its k nearest static
/// neighbours turns by less than dist_max (as the norm of the difference, sign-free) once the point
/// joins them. False with fewer than three neighbours or where they span no plane.
bool fits_static_map(const Point& point, const NeighborGrid& static_map,
                     const FrontEndConfig& config);

/// Map-based reverting: turns dynamic points that fit the static submap back to still.
/// `static_map` holds the points that survived removal [map frame].
void revert_by_map(const Window& window, const NeighborGrid& static_map,
                   const FrontEndConfig& config, std::vector<Labels>& labels);

}  // namespace dynamic_filter
