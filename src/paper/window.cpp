// SPDX-License-Identifier: MIT
#include "paper/window.hpp"

#include <utility>

#include "filter/keyframe.hpp"

namespace dynamic_filter {

std::optional<Window> WindowCutter::push(Scan scan) {
    std::optional<Window> closed;
    const bool keyframe = window_.keyframes.empty() ||
                          is_keyframe(window_.scans[window_.keyframes.back()], scan, config_);
    if (keyframe && window_.keyframes.size() == keyframes_) {
        closed = flush();
    }
    ++scans_;
    if (keyframe) window_.keyframes.push_back(window_.scans.size());
    window_.scans.push_back(std::move(scan));
    return closed;
}

std::optional<Window> WindowCutter::flush() {
    if (window_.scans.empty()) return std::nullopt;
    return std::exchange(window_, {});
}

}  // namespace dynamic_filter
