// SPDX-License-Identifier: MIT
/// Where a scan may have been taken, if the motion since the last one is hardly known.
#pragma once

#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// How far to search around the expected pose.
struct SearchWindow {
    double distance = 0.0;  ///< [m] to all sides
    double turn = 0.0;      ///< [rad] to both sides
};

/// Correlative matching, seen from above (Olson 2009): the displacements from the expected pose for
/// which what stands upright in the scan covers what stands upright in the map best; best first, at
/// most `count`, apart from each other. `map` and `scan` in the expected sensor frame, whose z axis
/// is taken for up. The ground is left out: its rings look the same from everywhere. Empty if
/// hardly anything stands upright.
std::vector<Pose> search_displacements(const Points& map, const Points& scan,
                                       const SearchWindow& window, std::size_t count);

}  // namespace dynamic_filter
