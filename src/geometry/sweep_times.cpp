// SPDX-License-Identifier: MIT
#include "dynamic_filter/motion.hpp"

#include <cmath>
#include <numbers>

#include "geometry/angle.hpp"
#include "geometry/scan_order.hpp"

namespace dynamic_filter {

namespace {

/// Shares 0..1 of the turn; those of points that are not measured have no meaning.
std::vector<float> shares_of_turn(const Points& points, const Sweep& sweep) {
    constexpr auto kTurn = static_cast<float>(2.0 * std::numbers::pi);
    const auto seam = static_cast<float>(sweep.seam);
    std::vector<float> shares(points.size(), 0.5F);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!is_measured(points[i])) continue;
        const float angle = angle_of(points[i].y(), points[i].x()) - seam;
        const float turned = (sweep.clockwise ? -angle : angle) / kTurn;
        shares[i] = turned - std::floor(turned);
    }
    return shares;
}

}  // namespace

std::vector<float> sweep_times(const Points& points, const Sweep& sweep) {
    const auto duration = static_cast<float>(sweep.duration);
    const auto shift = static_cast<float>(sweep.shift);
    std::vector<float> times(points.size(), 0.0F);
    const std::vector<float> shares =
        sweep.in_order ? order_shares(points) : shares_of_turn(points, sweep);
    if (shares.empty()) return times;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (is_measured(points[i])) times[i] = (shares[i] - 0.5F) * duration + shift;
    }
    return times;
}

}  // namespace dynamic_filter
