// SPDX-License-Identifier: MIT
#include "dynamic_filter/front_end/window.hpp"

#include <utility>

namespace dynamic_filter {

bool WindowCutter::is_keyframe(const Scan& scan) const {
    if (window_.keyframes.empty()) return true;
    const Scan& last = window_.scans[window_.keyframes.back()];
    const double moved =
        (scan.T_world_sensor.translation() - last.T_world_sensor.translation()).norm();
    return scan.stamp - last.stamp >= config_.keyframe_interval ||
           moved >= config_.keyframe_distance;
}

std::optional<Window> WindowCutter::push(Scan scan) {
    std::optional<Window> closed;
    const bool keyframe = is_keyframe(scan);
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
