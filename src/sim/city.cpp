// SPDX-License-Identifier: MIT
#include "sim/city.hpp"

#include <algorithm>
#include <cmath>

namespace dynamic_filter::sim::city {
namespace {

using Eigen::Vector2d;

/// [m] from the middle of the nearest of the streets that are `spacing` apart.
double from_street(double x, double spacing) {
    return std::abs(x - spacing * std::floor(x / spacing + 0.5));
}

}  // namespace

Vector2d node(int x, int y) { return {pitch[0] * x, pitch[1] * y}; }

Side side_of(const Block& block, int side) {
    constexpr int corner_x[] = {0, 1, 1, 0}, corner_y[] = {0, 0, 1, 1};
    const int next = (side + 1) % 4;
    const Vector2d corner = node(block.x + corner_x[side], block.y + corner_y[side]);
    const Vector2d along = node(corner_x[next] - corner_x[side], corner_y[next] - corner_y[side]);
    const double length = pitch[side % 2];
    const Vector2d axis = along / length;
    return {corner, axis, {-axis.y(), axis.x()}, length, bays_along[side % 2]};
}

double ground(const Vector2d& p) {
    constexpr double step = 0.3;  // [m] over which people step up
    const double away = std::min(from_street(p.x(), pitch[0]), from_street(p.y(), pitch[1]));
    return pavement * std::clamp((away - kerb) / step + 0.5, 0.0, 1.0);
}

std::uint64_t block_seed(std::uint64_t seed, const Block& block) {
    return hash(hash(seed, 0xb10c), static_cast<std::uint64_t>(block.x),
                static_cast<std::uint64_t>(block.y));
}

Eigen::Affine3f standing(const Vector2d& at, const Vector2d& axis, double z, double scale) {
    Eigen::Affine3d T = Eigen::Affine3d::Identity();
    T.linear() << axis.x(), -axis.y(), 0, axis.y(), axis.x(), 0, 0, 0, 1;
    T.linear() *= scale;
    T.translation() = Eigen::Vector3d(at.x(), at.y(), z);
    return T.cast<float>();
}

}  // namespace dynamic_filter::sim::city
