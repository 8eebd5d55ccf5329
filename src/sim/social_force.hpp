// SPDX-License-Identifier: MIT
/// Forces between people (Helbing & Molnar 1995; contact as in Helbing, Farkas & Vicsek 2000).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

namespace dynamic_filter::sim {

/// Something to which walkers yield: the robot, or a part of a vehicle.
struct Mover {
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    double radius = 0.4;
};

using Pair = std::pair<std::size_t, std::size_t>;

constexpr double neighbour_range = 3.0;  ///< [m] people farther away have no effect

/// Pairs of indices (smaller first) of points nearer than `range`. Their order depends only on the
/// points.
std::vector<Pair> pairs_within(const std::vector<Eigen::Vector2d>& points, double range);

/// `v` as a unit vector, or `other` if it has no direction.
Eigen::Vector2d unit_or(const Eigen::Vector2d& v, const Eigen::Vector2d& other);

/// [m/s2] force on a person who looks along `heading`, from another person at -`offset`, with `gap`
/// [m] between the bodies. Oncoming people step to their right.
Eigen::Vector2d person_force(const Eigen::Vector2d& heading, const Eigen::Vector2d& offset,
                             double gap, bool oncoming);

/// [m/s2] force away from the mover and, if it approaches, out of its lane.
Eigen::Vector2d mover_force(const Eigen::Vector2d& position, double radius, const Mover& mover);

}  // namespace dynamic_filter::sim
