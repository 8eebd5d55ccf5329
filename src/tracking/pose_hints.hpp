// SPDX-License-Identifier: MIT
/// What given poses, such as those of GPS, say about a trajectory that odometry found.
#pragma once

#include <optional>
#include <vector>

#include "tracking/pose_graph.hpp"

namespace dynamic_filter {

/// Hints for scans about 10 m of the way apart; for all with a given pose if those are sparse. Over
/// short distances the odometry is more accurate, over long ones the given poses are. So the
/// deviation that a hint allows is learnt from the disagreement over 1 to 100 m, of which the
/// odometry itself may cause a share that grows with the distance. Both lists are parallel to the
/// scans; scans without an entry are left out.
std::vector<PoseHint> hints_of(const std::vector<std::optional<Pose>>& T_world_given,
                               const std::vector<std::optional<Pose>>& T_odometry_sensor);

}  // namespace dynamic_filter
