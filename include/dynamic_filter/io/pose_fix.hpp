// SPDX-License-Identifier: MIT
/// @file
/// Common mistakes in poses, and their corrections.
///
/// - Frames: see each correction.
/// - Units: [m], except PoseFix::millimetres.
/// - Shapes: one pose at a time.
/// - Ownership: values.
/// - Threads: pure functions; thread-safe.
/// - Errors: none.
#pragma once

#include <string>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Corrections of poses: what the poses of the file really are.
enum class PoseFix {
    none,         ///< they are T_world_sensor [m], so nothing is corrected
    inverse,      ///< they are T_sensor_world
    camera,       ///< they are poses of a camera (x right, y down, z forward), not of the LiDAR
    lidar,        ///< they are poses of the LiDAR, but were read as those of a camera
    wxyz,         ///< quaternions are w x y z, but were read as x y z w
    xyzw,         ///< quaternions are x y z w, but were read as w x y z
    millimetres,  ///< translations are in millimetres
};

/// All corrections except `none`, in the order in which --pose-fix lists them.
const std::vector<PoseFix>& pose_fixes();
/// Name of a correction, as --pose-fix takes it.
std::string to_string(PoseFix fix);

/// Corrects a pose that was read without the correction; returns T_world_sensor.
Pose fixed(PoseFix fix, const Pose& pose);

}  // namespace dynamic_filter::io
