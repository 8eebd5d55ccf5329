// SPDX-License-Identifier: MIT
#include "geometry/thinning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/numbers.hpp"

namespace dynamic_filter {

namespace {

/// Distance to the third nearest of the other points. Of a surface between two layers of voxels,
/// a filter keeps points in pairs, one of each layer. `points` are sorted by x.
float third_neighbor(const Points& points, std::size_t at) {
    std::array<float, 3> nearest_sq;
    nearest_sq.fill(std::numeric_limits<float>::infinity());
    const auto look = [&](std::size_t i) {
        const float along = points[i].x() - points[at].x();
        const float distance_sq = (points[i] - points[at]).squaredNorm();
        if (distance_sq < nearest_sq.back()) {
            nearest_sq.back() = distance_sq;
            std::sort(nearest_sq.begin(), nearest_sq.end());
        }
        return along * along < nearest_sq.back();
    };
    for (std::size_t i = at + 1; i < points.size() && look(i); ++i) {
    }
    for (std::size_t i = at; i > 0 && look(i - 1); --i) {
    }
    return std::sqrt(nearest_sq.back());
}

/// Medians over some of the points within a shell around the sensor.
struct Spacing {
    float distance = 0.0F;  // [m] to the third nearest of the other points
    float angle = 0.0F;     // [rad] the same, as the sensor sees it
};
Spacing spacing_within(const Points& points, float least, float most) {
    constexpr std::size_t kAsked = 300;
    std::vector<std::size_t> within;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float range = points[i].norm();
        if (range >= least && range < most) within.push_back(i);
    }
    const std::size_t stride = within.size() / kAsked + 1;
    std::vector<float> distances, angles;
    for (std::size_t i = 0; i < within.size(); i += stride) {
        const float distance = third_neighbor(points, within[i]);
        distances.push_back(distance);
        angles.push_back(distance / points[within[i]].norm());
    }
    return {median(std::move(distances)), median(std::move(angles))};
}

}  // namespace

float thinning_of(std::span<const Point> points) {
    constexpr float kNearest = 0.5F;  // [m] closer points belong to the vehicle
    Points all;
    std::vector<float> ranges;
    for (const Point& p : points) {
        if (!is_measured(p) || p.norm() < kNearest) continue;
        all.push_back(p);
        ranges.push_back(p.norm());
    }
    constexpr std::size_t kFewest = 400;
    if (all.size() < kFewest) return 0.0F;
    std::sort(all.begin(), all.end(), [](const Point& a, const Point& b) { return a.x() < b.x(); });
    std::sort(ranges.begin(), ranges.end());
    const Spacing near = spacing_within(all, 0.0F, ranges[ranges.size() / 4]);
    const Spacing far =
        spacing_within(all, ranges[ranges.size() / 2], std::numeric_limits<float>::infinity());
    // The noise of ranges alone sets neighbors apart by some centimetres.
    constexpr float kLeast = 0.14F, kWider = 1.4F, kAlike = 0.47F;
    // A filter of larger voxels would leave nothing to work with: the points are no metres.
    constexpr float kMost = 3.0F;
    const bool alike = near.distance > kAlike * far.distance;
    const bool is_side = near.distance >= kLeast && near.distance <= kMost;
    return is_side && alike && near.angle >= kWider * far.angle ? near.distance : 0.0F;
}

}  // namespace dynamic_filter
