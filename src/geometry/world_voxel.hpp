// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/numbers.hpp"

namespace dynamic_filter::app {

/// A voxel by its place in the world, however far from the world's origin.
using WorldVoxel = std::array<std::int64_t, 3>;

/// `size` of the voxels [m].
inline WorldVoxel world_voxel(const Eigen::Vector3d& place, double size) {
    const Eigen::Vector3d cell = (place / size).array().floor();
    return {static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
            static_cast<std::int64_t>(cell.z())};
}

}  // namespace dynamic_filter::app
