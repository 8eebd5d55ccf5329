// SPDX-License-Identifier: MIT
#include "geometry/no_returns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dynamic_filter {

std::size_t drop_no_returns(Points& points) {
    constexpr std::size_t kLeast = 50;
    constexpr float kLeastShare = 0.003F;
    constexpr float kAlike = 1e-4F;    // share of the range; coordinates may be rounded
    constexpr float kHeights = 0.02F;  // share of the range
    float farthest = 0.0F;             // [m^2]
    std::size_t measured = 0;
    for (const Point& p : points) {
        const float squared = p.squaredNorm();
        if (!(squared > 0.0F) || !std::isfinite(squared)) continue;
        farthest = std::max(farthest, squared);
        ++measured;
    }
    const float least = farthest * (1.0F - kAlike) * (1.0F - kAlike);
    const auto is_farthest = [&](const Point& p) {
        const float squared = p.squaredNorm();
        return squared >= least && squared <= farthest && squared > 0.0F;
    };
    std::size_t count = 0;
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    for (const Point& p : points) {
        if (!is_farthest(p)) continue;
        ++count;
        low = std::min(low, p.z());
        high = std::max(high, p.z());
    }
    const bool are_few =
        count < kLeast || static_cast<float>(count) < kLeastShare * static_cast<float>(measured);
    if (are_few || high - low < kHeights * std::sqrt(farthest)) return 0;
    std::replace_if(points.begin(), points.end(), is_farthest, Point(Point::Zero()));
    return count;
}

}  // namespace dynamic_filter
