// SPDX-License-Identifier: MIT
#include "sim/obstacles.hpp"

#include <algorithm>
#include <cmath>

namespace dynamic_filter::sim {
namespace {

constexpr double cut_off = 3.0;  // [m]

std::size_t index_of(int row, int column, int columns) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
}

/// Lowers the field where this obstacle is nearer than all previous ones.
void imprint(DistanceField& field, const Obstacle& obstacle) {
    const double reach = obstacle.half.norm() + obstacle.radius + cut_off;
    const Eigen::Vector2d low = (obstacle.centre - field.origin).array() - reach;
    const Eigen::Vector2d high = (obstacle.centre - field.origin).array() + reach;
    const auto index = [&](double v, int count) {
        return std::clamp(static_cast<int>(std::floor(v / field.cell)), 0, count - 1);
    };
    for (int row = index(low.y(), field.rows); row <= index(high.y(), field.rows); ++row) {
        for (int col = index(low.x(), field.columns); col <= index(high.x(), field.columns);
             ++col) {
            const Eigen::Vector2d p = field.origin + field.cell * Eigen::Vector2d(col, row);
            float& value = field.values[index_of(row, col, field.columns)];
            value = std::min(value, static_cast<float>(distance(obstacle, p)));
        }
    }
}

}  // namespace

double distance(const Obstacle& obstacle, const Eigen::Vector2d& p) {
    const Eigen::Vector2d d = p - obstacle.centre;
    const Eigen::Vector2d across(-obstacle.axis.y(), obstacle.axis.x());
    const double x = std::abs(d.dot(obstacle.axis)) - obstacle.half.x();
    const double y = std::abs(d.dot(across)) - obstacle.half.y();
    const double outside =
        std::sqrt(std::max(x, 0.0) * std::max(x, 0.0) + std::max(y, 0.0) * std::max(y, 0.0));
    return outside + std::min(std::max(x, y), 0.0) - obstacle.radius;
}

DistanceField distance_field(const std::vector<Obstacle>& obstacles, const Eigen::Vector2d& low,
                             const Eigen::Vector2d& high) {
    DistanceField field;
    field.origin = low;
    field.columns = static_cast<int>((high.x() - low.x()) / field.cell) + 2;
    field.rows = static_cast<int>((high.y() - low.y()) / field.cell) + 2;
    field.values.assign(index_of(field.rows, 0, field.columns), static_cast<float>(cut_off));
    for (const Obstacle& obstacle : obstacles) imprint(field, obstacle);
    return field;
}

DistanceField::Sample DistanceField::at(const Eigen::Vector2d& p) const {
    const double x = std::clamp((p.x() - origin.x()) / cell, 0.0, columns - 1.001);
    const double y = std::clamp((p.y() - origin.y()) / cell, 0.0, rows - 1.001);
    const int col = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const double u = x - col;
    const double v = y - row;
    const auto value = [&](int r, int c) {
        return static_cast<double>(values[index_of(r, c, columns)]);
    };
    const double a = value(row, col), b = value(row, col + 1);
    const double c = value(row + 1, col), d = value(row + 1, col + 1);
    return {(a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v,
            {((b - a) * (1 - v) + (d - c) * v) / cell, ((c - a) * (1 - u) + (d - b) * u) / cell}};
}

bool is_clear(const DistanceField& field, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
              double radius) {
    const int steps = static_cast<int>((b - a).norm() / 0.2) + 1;
    for (int i = 0; i <= steps; ++i) {
        if (field.at(a + (b - a) * i / steps).distance < radius) return false;
    }
    return true;
}

}  // namespace dynamic_filter::sim
