// SPDX-License-Identifier: MIT
#include "tracking/pose_jump.hpp"

#include <algorithm>

namespace dynamic_filter {

std::optional<double> pose_jump(const std::optional<StampedPose>& before_last,
                                const std::optional<StampedPose>& last, const StampedPose& now) {
    constexpr double kLeast = 2.0;          // [m] more than any pose noise
    constexpr double kAcceleration = 50.0;  // [m/s^2] more than any vehicle
    if (!before_last || !last) return std::nullopt;
    const double passed = now.stamp - last->stamp, earlier = last->stamp - before_last->stamp;
    if (!(passed > 0.0) || !(earlier > 0.0)) return std::nullopt;
    const Eigen::Vector3d velocity =
        (last->T_world_sensor.translation() - before_last->T_world_sensor.translation()) / earlier;
    const Eigen::Vector3d expected = last->T_world_sensor.translation() + passed * velocity;
    const double moved =
        (now.T_world_sensor.translation() - last->T_world_sensor.translation()).norm();
    // If the stream alternates between two sensors of one vehicle, the extrapolated position is
    // wrong; then the last position counts.
    const double off = std::min(moved, (now.T_world_sensor.translation() - expected).norm());
    // The velocity itself may have changed during the previous step.
    const double possible = kLeast + kAcceleration * passed * (0.5 * passed + earlier);
    return off > possible ? std::optional(off) : std::nullopt;
}

}  // namespace dynamic_filter
