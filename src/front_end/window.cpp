// SPDX-License-Identifier: MIT
#include "dynamic_filter/front_end/window.hpp"

#include <utility>

namespace dynamic_filter {

bool is_keyframe(const Scan& last, const Scan& scan, const Config::Submap& config) {
    const double moved =
        (scan.T_world_sensor.translation() - last.T_world_sensor.translation()).norm();
    return scan.stamp - last.stamp >= config.keyframe_interval || moved >= config.keyframe_distance;
}

std::optional<Window> WindowCutter::push(Scan scan) {
    std::optional<Window> closed;
    const bool keyframe = window_.keyframes.empty() ||
                          is_keyframe(window_.scans[window_.keyframes.back()], scan, config_);
    if (keyframe && window_.keyframes.size() == static_cast<std::size_t>(config_.keyframes)) {
        closed = flush();
    }
    if (keyframe) window_.keyframes.push_back(window_.scans.size());
    window_.scans.push_back(std::move(scan));
    return closed;
}

std::optional<Window> WindowCutter::flush() {
    if (window_.scans.empty()) return std::nullopt;
    return std::exchange(window_, {});
}

}  // namespace dynamic_filter
