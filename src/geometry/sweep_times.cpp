// SPDX-License-Identifier: MIT
#include "dynamic_filter/motion.hpp"

#include <cmath>
#include <numbers>

namespace dynamic_filter {

std::vector<float> sweep_times(const Points& points, const Sweep& sweep) {
    constexpr auto kTurn = static_cast<float>(2.0 * std::numbers::pi);
    const auto seam = static_cast<float>(sweep.seam), duration = static_cast<float>(sweep.duration);
    std::vector<float> times(points.size(), 0.0F);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!is_measured(points[i])) continue;
        const float angle = std::atan2(points[i].y(), points[i].x()) - seam;
        const float turned = (sweep.clockwise ? -angle : angle) / kTurn;
        times[i] = (turned - std::floor(turned) - 0.5F) * duration;
    }
    return times;
}

}  // namespace dynamic_filter
