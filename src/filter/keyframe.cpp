// SPDX-License-Identifier: MIT
#include "filter/keyframe.hpp"

namespace dynamic_filter {

bool is_keyframe(const Scan& last, const Scan& scan, const KeyframeConfig& config) {
    const double moved =
        (scan.T_world_sensor.translation() - last.T_world_sensor.translation()).norm();
    return scan.stamp - last.stamp >= config.interval || moved >= config.distance;
}

}  // namespace dynamic_filter
