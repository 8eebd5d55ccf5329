// SPDX-License-Identifier: MIT
/// Points that stand for beams of which nothing came back.
#pragma once

#include <cstddef>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Some drivers and simulators write a beam without a return as a point at the greatest range, so
/// that such points lie on a sphere around the sensor. Moves them to the origin, where points are
/// no measurements (is_measured()), and returns their number. `points`: [m], sensor frame. Nothing
/// is done if fewer than 50 points, or fewer than 0.3 % of the measured ones, are as far away as
/// the farthest, or if all of these are at nearly the same height: surfaces do not have so many
/// points at one range, but a single beam on a flat ground has.
std::size_t drop_no_returns(Points& points);

}  // namespace dynamic_filter
