// SPDX-License-Identifier: MIT
/// @file
/// The poses of a trajectory that agree best with what is known about them: motions between two
/// scans, and hints about single poses. Least squares on SE(3) with robust weights.
///
/// - Units: [m], [rad].
/// - Frames: poses T_world_sensor; information is that of a displacement in the sensor frame.
/// - Shapes: one pose per scan; any number of motions and hints.
/// - Threads: pure functions; thread-safe. Results do not depend on the number of threads.
/// - Errors: none.
#pragma once

#include <span>
#include <vector>

#include "dynamic_filter/types.hpp"
#include "tracking/registration.hpp"

namespace dynamic_filter {

/// How a scan lies in the frame of another one.
struct Motion {
    std::size_t from = 0, to = 0;  ///< indices of scans
    Pose T_from_to = Pose::Identity();
    Information information = Information::Identity();
    /// True: the motion may be wrong as a whole, as that of a loop. Its weight then falls if the
    /// rest contradicts it.
    bool is_doubtful = false;
};

/// What another source says about the pose of a scan. Its weight falls if the rest contradicts it.
struct PoseHint {
    std::size_t scan = 0;
    Pose T_world_sensor = Pose::Identity();
    Information information = Information::Identity();
};

/// Moves the poses from `start` until they agree best with motions and hints. Without hints, the
/// first pose stays where it is. Scans that no motion links to others keep their place if no hint
/// speaks of them.
std::vector<Pose> solve_pose_graph(std::vector<Pose> start, std::span<const Motion> motions,
                                   std::span<const PoseHint> hints);

}  // namespace dynamic_filter
