// SPDX-License-Identifier: MIT
/// Finds the places of a drive on those of a map by what they look like.
#pragma once

#include <vector>

#include "check/local_places.hpp"

namespace dynamic_filter::io {

constexpr std::size_t kFewestOnMap = 3;  ///< places that agree

/// A place of the drive, and where it lies in the world of the map.
struct Found {
    const Local* of_drive;
    Pose motion;  // from the drive's own world to that of the map
    double fit = 0.0;
};

/// The places of the drive that lie on the map where most of them agree. Empty if fewer than
/// kFewestOnMap do, or if others have nearly as many: then places of the map look alike, and
/// nothing tells which of them it is. Runs in parallel.
std::vector<Found> recognize(const std::vector<Local>& map, const std::vector<Local>& drive);

}  // namespace dynamic_filter::io
