// SPDX-License-Identifier: MIT
/// When the points of a rotating sensor were measured, by their order in the file.
#pragma once

#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// How far the sensor had turned when it measured each point, as a share 0..1 of the scan. Points
/// may be in the order in which they were measured, also if a scan is more than one turn, or row by
/// row, where each row is a turn of one laser. Points that are not measured have the share 0.5.
/// Empty if the azimuth does not advance steadily in either of these orders.
std::vector<float> order_shares(const Points& points);

}  // namespace dynamic_filter
