// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Mean translation and chordal mean of the rotations: the rotation nearest to their sum
/// (Sec. III-B2, "averaged over the entire sequence"). Needs at least one pose.
Pose mean_pose(std::span<const Pose> poses);

/// A shift near `pose` from which floats are precise. It is a whole multiple of `step`, so that
/// voxels keep their borders.
Eigen::Vector3d nearby_origin(const Pose& pose, double step);

}  // namespace dynamic_filter
