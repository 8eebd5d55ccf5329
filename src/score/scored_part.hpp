// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <optional>

namespace dynamic_filter::app {

/// Which points are scored: by their distance from the sensor [m], both bounds included, and by
/// their place in the world.
struct ScoredPart {
    double min = 0.0;
    double max = std::numeric_limits<double>::infinity();
    std::optional<Eigen::AlignedBox3d> box{};
};

}  // namespace dynamic_filter::app
