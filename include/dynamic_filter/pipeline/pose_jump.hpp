// SPDX-License-Identifier: MIT
/// Whether a trajectory breaks: a loop was closed, or a localisation was lost and found.
#pragma once

#include <optional>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Where the sensor was when.
struct StampedPose {
    Pose T_world_sensor = Pose::Identity();
    double stamp = 0.0;  ///< [s]
};

/// Metres that `now` is off from the last pose and from where the last two led, if that is more
/// than a vehicle can do: 2 m, and what 50 m/s^2 add up to. Before there are two poses, and where
/// stamps do not grow, nothing is known. Empty: no jump.
std::optional<double> pose_jump(const std::optional<StampedPose>& before_last,
                                const std::optional<StampedPose>& last, const StampedPose& now);

}  // namespace dynamic_filter
