// SPDX-License-Identifier: MIT
#include "navigation/surface_map.hpp"

#include <algorithm>

namespace dynamic_filter::app {

namespace {

constexpr std::uint32_t kNoSurface = UINT32_MAX;
// So few points above a floor of many are no obstacle, but what the filter missed of somebody.
constexpr float kFewPoints = 5.0F, kFewShare = 0.03F;

}  // namespace

SurfaceMap::SurfaceMap(const std::vector<Surface>& surfaces, const Area& area)
    : surfaces_(surfaces), area_(area), first_(area.size(), kNoSurface) {
    for (std::size_t i = surfaces.size(); i-- > 0;) {
        first_[area.index(surfaces[i].x, surfaces[i].y)] = static_cast<std::uint32_t>(i);
    }
}

bool SurfaceMap::blocks(int x, int y, float floor, const Robot& robot) const {
    bool blocked = false;
    float points_of_floor = 0.0F;
    each(x, y, [&](std::size_t i) {
        const Surface& s = surfaces_[i];
        const auto points = static_cast<float>(s.points);
        if (s.top <= floor + robot.step) {
            points_of_floor = points;
            return true;
        }
        const bool is_stray =
            points < 2.0F || points < std::min(kFewPoints, kFewShare * points_of_floor);
        blocked = s.bottom < floor + robot.height && !is_stray;
        return !blocked && s.bottom < floor + robot.height;
    });
    return blocked;
}

bool SurfaceMap::is_flat(std::size_t i, float cell) const {
    constexpr float kWide = 0.1F, kThick = 0.05F;  // [m]
    constexpr int kLeast = 3;                      // cells
    const auto reach = std::max(1, static_cast<int>(std::lround(kWide / cell)));
    const Surface& s = surfaces_[i];
    int beside = 0;
    for (int y = s.y - reach; y <= s.y + reach; ++y) {
        for (int x = s.x - reach; x <= s.x + reach; ++x) {
            if (x == s.x && y == s.y) continue;
            each(x, y, [&](std::size_t k) {
                const bool is_level = std::abs(surfaces_[k].top - s.top) <= kThick;
                beside += is_level ? 1 : 0;
                return !is_level;
            });
            if (beside >= kLeast) return true;
        }
    }
    return false;
}

bool SurfaceMap::stands(std::size_t i, float cell, const Robot& robot) const {
    constexpr float kClose = 0.5F;  // [m]
    const Surface& s = surfaces_[i];
    const auto reach = static_cast<int>(kClose / cell);
    bool found = false;
    for (int y = s.y - reach; y <= s.y + reach && !found; ++y) {
        for (int x = s.x - reach; x <= s.x + reach && !found; ++x) {
            each(x, y, [&](std::size_t k) {
                found = surfaces_[k].top < s.top - robot.step &&
                        surfaces_[k].top > s.top - robot.height;
                return !found && surfaces_[k].top < s.top;
            });
        }
    }
    return found;
}

}  // namespace dynamic_filter::app
