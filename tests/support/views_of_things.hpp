// SPDX-License-Identifier: MIT
/// Points that a sensor sees of a box and of a post, on the sides that face it.
#pragma once

#include <numbers>

#include "support/random.hpp"

namespace dynamic_filter::test {

constexpr std::size_t kPointsOfView = 220;

/// A box of 4 x 1.6 x 1.4 m that stands on z = 0; `middle` is that of its base. Noise of 1 cm.
inline Points view_of_box(const Eigen::Vector2d& middle, const Point& from, std::uint64_t seed) {
    Random random(seed);
    const Eigen::Vector2f half(2.0F, 0.8F), center = middle.cast<float>();
    const Eigen::Vector2f to = from.head<2>() - center;
    Points points;
    while (points.size() < kPointsOfView) {
        Eigen::Vector2f at(random.uniform_f(-half.x(), half.x()),
                           random.uniform_f(-half.y(), half.y()));
        const Eigen::Index axis = random.chance(half.x() / (half.x() + half.y())) ? 1 : 0;
        if (std::abs(to[axis]) < half[axis]) continue;  // that side faces neither way
        at[axis] = to[axis] < 0.0F ? -half[axis] : half[axis];
        at[axis] += random.uniform_f(-0.02, 0.02);
        points.emplace_back(center.x() + at.x(), center.y() + at.y(), random.uniform_f(0.0, 1.4));
    }
    return points;
}

/// A post of 0.15 m radius and 2 m height.
inline Points view_of_post(const Eigen::Vector2d& middle, const Point& from, std::uint64_t seed) {
    Random random(seed);
    const Eigen::Vector2f center = middle.cast<float>();
    Points points;
    while (points.size() < kPointsOfView) {
        const float angle = random.uniform_f(0.0, 2.0 * std::numbers::pi);
        const Eigen::Vector2f out(std::cos(angle), std::sin(angle));
        if (out.dot(from.head<2>() - center) < 0.0F) continue;
        const Eigen::Vector2f at = center + (0.15F + random.uniform_f(-0.01, 0.01)) * out;
        points.emplace_back(at.x(), at.y(), random.uniform_f(0.0, 2.0));
    }
    return points;
}

}  // namespace dynamic_filter::test
