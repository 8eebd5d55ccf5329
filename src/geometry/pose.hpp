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

/// A rotation by roll, then pitch, then yaw [deg] about the fixed axes x, y and z, as in URDF and
/// in static_transform_publisher.
Eigen::Matrix3d turned_by(const Eigen::Vector3d& roll_pitch_yaw_deg);

/// A pose at a place [m] with such a rotation.
Pose placed(const Eigen::Vector3d& at, const Eigen::Vector3d& roll_pitch_yaw_deg);

/// The angles [deg] of turned_by(); the pitch is within 90 degrees of zero.
Eigen::Vector3d angles_of(const Eigen::Matrix3d& rotation);

}  // namespace dynamic_filter
