// SPDX-License-Identifier: MIT
/// The height of the floor at any place of the world.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "navigation/floor.hpp"

namespace dynamic_filter::app {

struct Ground {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m] corner of cell (0, 0) in the world
    double cell = 0.0;                                 ///< [m]
    Area area{};
    std::vector<float> height{};  ///< [m] above `origin`, by Area::index(); kNoFloor where none is

    /// Whether the place is within `distance` [m] of the floor below or above it.
    [[nodiscard]] bool is_near(const Eigen::Vector3d& place, double distance) const {
        const Eigen::Vector3d at = place - origin;
        const int x = static_cast<int>(std::floor(at.x() / cell));
        const int y = static_cast<int>(std::floor(at.y() / cell));
        return area.holds(x, y) &&  // NaN is near nothing
               std::abs(at.z() - static_cast<double>(height[area.index(x, y)])) <= distance;
    }
};

}  // namespace dynamic_filter::app
