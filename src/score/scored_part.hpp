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
    double min_horizontal = 0.0;        ///< [m] least distance from the sensor's axis
    bool unlabelled_is_static = false;  ///< true: points without ground truth are scored as static
};

/// The points that ERASOR scores, of those of another part.
inline ScoredPart part_of_erasor(ScoredPart part) {
    part.min_horizontal = 2.7;
    part.unlabelled_is_static = true;
    return part;
}

}  // namespace dynamic_filter::app
