// SPDX-License-Identifier: MIT
#include "sim/social_force.hpp"

#include <algorithm>
#include <cmath>

#include "sim/portable.hpp"

namespace dynamic_filter::sim {
namespace {

using Eigen::Vector2d;

constexpr double pair_strength = 2.5, pair_range = 0.3;  // [m/s2], [m]
constexpr double contact_stiffness = 20.0;               // [1/s2]
constexpr double mover_strength = 4.0, mover_range = 0.5;
constexpr double rear_weight = 0.3;  // weight of events behind the person

}  // namespace

std::vector<Pair> pairs_within(const std::vector<Vector2d>& points, double range) {
    if (points.empty()) return {};
    Vector2d low = points.front(), high = points.front();
    for (const Vector2d& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const int columns = static_cast<int>((high.x() - low.x()) / range) + 1;
    const int rows = static_cast<int>((high.y() - low.y()) / range) + 1;
    std::vector<std::vector<std::size_t>> cells(static_cast<std::size_t>(columns) *
                                                static_cast<std::size_t>(rows));
    const auto index_of = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(x);
    };
    const auto cell_of = [&](const Vector2d& p) -> Eigen::Vector2i {
        return ((p - low) / range).cast<int>();
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto cell = cell_of(points[i]);
        cells[index_of(cell.x(), cell.y())].push_back(i);
    }
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto cell = cell_of(points[i]);
        for (int y = std::max(0, cell.y() - 1); y <= std::min(rows - 1, cell.y() + 1); ++y) {
            for (int x = std::max(0, cell.x() - 1); x <= std::min(columns - 1, cell.x() + 1); ++x) {
                for (const std::size_t j : cells[index_of(x, y)]) {
                    const bool near = (points[j] - points[i]).squaredNorm() < range * range;
                    if (j > i && near) pairs.emplace_back(i, j);
                }
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

Vector2d unit_or(const Vector2d& v, const Vector2d& other) {
    const double n = std::sqrt(v.squaredNorm());
    return n > 1e-6 ? Vector2d(v / n) : other;
}

Vector2d person_force(const Vector2d& heading, const Vector2d& offset, double gap, bool oncoming) {
    const Vector2d away = unit_or(offset, Vector2d::UnitX());
    const double ahead = -away.dot(heading);
    const double weight = rear_weight + (1.0 - rear_weight) * 0.5 * (1.0 + ahead);
    const double strength = weight * pair_strength * portable_exp(-gap / pair_range);
    const double contact = gap < 0.0 ? -contact_stiffness * gap : 0.0;
    Vector2d force = (strength + contact) * away;
    if (oncoming && ahead > 0.5) {  // otherwise two people who meet head-on would block each other
        force += 0.7 * strength * Vector2d(heading.y(), -heading.x());
    }
    return force;
}

Vector2d mover_force(const Vector2d& position, double radius, const Mover& mover) {
    const Vector2d offset = position - mover.centre;
    const double gap = std::sqrt(offset.squaredNorm()) - radius - mover.radius;
    if (gap > 3.0) return Vector2d::Zero();
    const Vector2d away = unit_or(offset, Vector2d::UnitX());
    Vector2d force = mover_strength * portable_exp(-gap / mover_range) * away;
    const Vector2d course = unit_or(mover.velocity, Vector2d::Zero());
    const double along = offset.dot(course);
    const Vector2d aside = offset - along * course;
    const double lane = mover.radius + radius + 0.25;
    const double off_lane = std::sqrt(aside.squaredNorm());
    if (along > 0.0 && off_lane < lane && mover.velocity.squaredNorm() > 0.01) {
        const Vector2d right(course.y(), -course.x());
        force += 2.0 * (1.0 - gap / 3.0) * unit_or(aside, right);
    }
    return force;
}

}  // namespace dynamic_filter::sim
