// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::io {

/// The point cloud of scan i without its pose. Throws InputError.
Cloud read_scan(const Sequence& sequence, std::size_t i);

/// Transforms the points of a cloud in world coordinates into the sensor frame; in double, because
/// the world may be far from its origin.
Points into_sensor(const Cloud& cloud, const Pose& T_world_sensor);

/// True if the pose is farther away than the circumference of the Earth; such a value is a wrong
/// number or has a wrong unit.
bool is_absurdly_far(const Pose& T_world_sensor);

}  // namespace dynamic_filter::io
