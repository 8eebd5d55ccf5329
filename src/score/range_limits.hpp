// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace dynamic_filter::app {

/// Which points are scored, by their distance from the sensor [m]. Both bounds are included.
struct RangeLimits {
    double min = 0.0;
    double max = std::numeric_limits<double>::infinity();
};

}  // namespace dynamic_filter::app
