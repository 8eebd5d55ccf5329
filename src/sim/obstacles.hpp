// SPDX-License-Identifier: MIT
/// Obstacles for walkers: static shapes in the ground plane, and their distance field.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dynamic_filter::sim {

/// A disc (half is zero, radius is not) or a rotated rectangle.
struct Obstacle {
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    Eigen::Vector2d half = Eigen::Vector2d::Zero();
    Eigen::Vector2d axis = Eigen::Vector2d::UnitX();  ///< unit vector along half.x()
    double radius = 0.0;
};

/// [m] Distance from `p` to the obstacle, negative inside.
double distance(const Obstacle& obstacle, const Eigen::Vector2d& p);

/// Distance to the nearest obstacle, sampled on a grid and interpolated.
struct DistanceField {
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();
    double cell = 0.1;
    int columns = 0;
    int rows = 0;
    std::vector<float> values;

    struct Sample {
        double distance = 0.0;
        /// Gradient: direction away from the obstacle.
        Eigen::Vector2d away = Eigen::Vector2d::Zero();
    };
    [[nodiscard]] Sample at(const Eigen::Vector2d& p) const;
};

/// Computes the field on [low, high]; distances above 3 m are set to 3 m.
DistanceField distance_field(const std::vector<Obstacle>& obstacles, const Eigen::Vector2d& low,
                             const Eigen::Vector2d& high);

/// True if a body of this radius can go straight from `a` to `b`.
bool is_clear(const DistanceField& field, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
              double radius);

}  // namespace dynamic_filter::sim
