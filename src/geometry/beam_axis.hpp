// SPDX-License-Identifier: MIT
/// About which axis the beams of a sensor fan out, if its driver does not call this axis z.
#pragma once

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// The axis of the sensor frame along which the beams reach least: 0, 1, 2 for x, y, z. It is z,
/// unless they reach clearly less far along another one, as in a frame with a camera's axes, or
/// that of a sensor mounted on its side.
Eigen::Index beam_axis(const Points& points);

/// The same scan in a frame whose z axis is this axis; the other two follow in cyclic order. Range
/// images need it, because their pixels are narrow at the poles.
Scan turned_to_z(Scan scan, Eigen::Index axis);

}  // namespace dynamic_filter
