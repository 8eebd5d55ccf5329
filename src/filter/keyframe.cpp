// SPDX-License-Identifier: MIT
#include "filter/keyframe.hpp"

namespace dynamic_filter {

bool is_keyframe(const Scan& last, const Scan& scan, const KeyframeConfig& config) {
    const double moved =
        (scan.T_world_sensor.translation() - last.T_world_sensor.translation()).norm();
    return scan.stamp - last.stamp >= config.interval || moved >= config.distance;
}

bool KeyframeChoice::take(const Scan& scan) {
    if (scan.sensor >= last_.size()) last_.resize(scan.sensor + 1);
    std::optional<Scan>& last = last_[scan.sensor];
    if (last && !is_keyframe(*last, scan, config_)) return false;
    last = Scan{{}, scan.T_world_sensor, scan.stamp, scan.index};
    return true;
}

}  // namespace dynamic_filter
