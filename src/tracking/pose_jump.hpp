// SPDX-License-Identifier: MIT
/// Detects breaks of a trajectory, such as a correction after a loop closure, or a localization
/// that was lost and found again.
#pragma once

#include <optional>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// [s] A stamp that goes back farther is not late: the recording, or the clock, began again.
inline constexpr double kRestart = 1.0;

/// A pose and the time at which the sensor had it.
struct StampedPose {
    Pose T_world_sensor = Pose::Identity();
    double stamp = 0.0;  ///< [s]
};

/// Returns how far [m] `now` is from the expected position, if that is more than a vehicle can
/// move; empty if there is no jump. The distance is measured from the last pose and from the
/// position extrapolated from the last two poses; the smaller one counts. The limit is 2 m plus the
/// distance that an acceleration of 50 m/s^2 makes possible. The result is also empty before there
/// are two poses, and if the stamps do not increase.
std::optional<double> pose_jump(const std::optional<StampedPose>& before_last,
                                const std::optional<StampedPose>& last, const StampedPose& now);

}  // namespace dynamic_filter
