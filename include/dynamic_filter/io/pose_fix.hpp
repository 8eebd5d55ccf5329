// SPDX-License-Identifier: MIT
/// @file
/// What users get wrong about poses, and how it is put right.
///
/// - Frames: what each fix says.
/// - Units: [m] but for millimetres.
/// - Shapes: one pose at a time.
/// - Ownership: values.
/// - Threads: pure functions; thread-safe.
/// - Errors: none.
#pragma once

#include <string>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// What the poses of a recording were taken for, wrongly.
enum class PoseFix {
    none,         ///< they are T_world_sensor [m]
    inverse,      ///< they are T_sensor_world
    camera,       ///< they are poses of a camera that looks ahead: x right, y down, z forward
    lidar,        ///< they were taken for a camera's, but are the LiDAR's
    wxyz,         ///< quaternions are w x y z, but were read as x y z w
    xyzw,         ///< the other way round
    millimetres,  ///< translations are in millimetres
};

/// All but none, by the names that --pose-fix takes.
const std::vector<PoseFix>& pose_fixes();
/// By that name.
std::string to_string(PoseFix fix);

/// T_world_sensor of a pose that was read without the fix.
Pose fixed(PoseFix fix, const Pose& pose);

}  // namespace dynamic_filter::io
