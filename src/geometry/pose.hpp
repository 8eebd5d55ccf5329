// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Mean of poses: the mean translation, and the chordal mean of the rotations, which is the
/// rotation nearest to their sum (Sec. III-B2, "averaged over the entire sequence"). Needs at least
/// one pose.
Pose mean_pose(std::span<const Pose> poses);

/// Returns an origin near `pose` [m, world frame], so that coordinates relative to it are small
/// enough for float precision. It is a whole multiple of `step` [m], so that voxel borders stay
/// where they are.
Eigen::Vector3d nearby_origin(const Pose& pose, double step);

}  // namespace dynamic_filter
