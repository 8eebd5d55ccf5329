// SPDX-License-Identifier: MIT
/// Finds single poses that lie apart from those before and after them.
#pragma once

#include <span>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Indices of poses that are farther from the middle between their neighbours than a vehicle can
/// be: an acceleration of 10 m/s^2, and 0.3 m of noise; and whose neighbours fit to each other
/// without them. `stamps` [s] are parallel to the poses.
/// Poses that are not finite are left out; the first and the last one are never among them. In
/// ascending order.
std::vector<std::size_t> outliers_of(std::span<const Pose> poses, std::span<const double> stamps);

}  // namespace dynamic_filter::io
