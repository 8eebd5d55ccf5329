// SPDX-License-Identifier: MIT
/// Finds candidate poses of a scan when the motion since the previous scan is hardly known.
#pragma once

#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// How far to search around the expected pose.
struct SearchWindow {
    double distance = 0.0;  ///< [m] in each horizontal direction
    double turn = 0.0;      ///< [rad] to each side
};

/// Correlative matching, seen from above (Olson 2009). Returns displacements from the expected pose
/// for which the upright structures of the scan cover those of the map best: at most `count`, best
/// first, and well apart from each other. `map` and `scan` are in the expected sensor frame, whose
/// z axis is taken as the vertical. The ground is left out, because its rings look the same from
/// everywhere. Empty if the scan has hardly any upright structure.
std::vector<Pose> search_displacements(const Points& map, const Points& scan,
                                       const SearchWindow& window, std::size_t count);

}  // namespace dynamic_filter
