// SPDX-License-Identifier: MIT
#pragma once

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Of the points that a scan must have hit or seen through, the share that it saw through: what two
/// places that only look alike have otherwise shows there. `scan` and `points` are in the sensor
/// frame of the scan. Points behind what the scan shows, and where it shows nothing, do not count.
/// 0 if none counts.
double seen_through(const Points& scan, const Points& points);

}  // namespace dynamic_filter::io
