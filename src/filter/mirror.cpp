// SPDX-License-Identifier: MIT
#include "filter/mirror.hpp"

#include <algorithm>
#include <cmath>

namespace dynamic_filter {

std::optional<std::size_t> Mirror::cell(float along, float z, int angle) const {
    const int column = static_cast<int>(std::floor((along - plane.from) / kMirrorCell));
    const int row = static_cast<int>(std::floor((z - lowest) / kMirrorCell));
    if (column < 0 || column >= columns || row < 0 || row >= rows) return std::nullopt;
    return static_cast<std::size_t>((angle * rows + row) * columns + column);
}

std::optional<Crossing> crossing(const UprightPlane& plane, const Point& sensor, const Point& point,
                                 float least) {
    const float front = plane.height(sensor.head<2>()), behind = -plane.height(point.head<2>());
    if (front < kBehindMirror || behind < least || behind > kDeepInMirror) return std::nullopt;
    const Point way = point - sensor;
    const Point at = sensor + front / (front + behind) * way;
    const float cosine = (front + behind) / way.norm();
    return Crossing{plane.along(at.head<2>()), at.z(), behind,
                    cosine > 0.7F    ? 0
                    : cosine > 0.35F ? 1
                                     : 2};
}

bool is_reflected(const Mirror& mirror, const Point& sensor, const Point& point, float least) {
    const auto at = crossing(mirror.plane, sensor, point, least);
    if (!at) return false;
    const auto cell = mirror.cell(at->along, at->z, at->angle);
    return cell && mirror.reflects[*cell];
}

bool is_on(const Mirror& mirror, const Point& point) {
    constexpr float kNear = 0.15F;  // [m]
    if (std::abs(mirror.plane.height(point.head<2>())) > kNear) return false;
    const float along = mirror.plane.along(point.head<2>());
    for (int angle = 0; angle < kMirrorAngles; ++angle) {
        const auto cell = mirror.cell(along, point.z(), angle);
        if (cell && mirror.reflects[*cell]) return true;
    }
    return false;
}

bool is_reflected(const std::vector<Mirror>& mirrors, const Point& sensor, const Point& point,
                  float least) {
    return std::any_of(mirrors.begin(), mirrors.end(),
                       [&](const Mirror& m) { return is_reflected(m, sensor, point, least); });
}

bool is_on(const std::vector<Mirror>& mirrors, const Point& point) {
    return std::any_of(mirrors.begin(), mirrors.end(),
                       [&](const Mirror& m) { return is_on(m, point); });
}

}  // namespace dynamic_filter
