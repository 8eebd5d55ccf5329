// SPDX-License-Identifier: MIT
/// What must hold in every scene.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/scene.hpp"

namespace dynamic_filter::sim {

inline Crowd walked(const Scene& scene, double duration) {
    const auto movers = [&scene](double t) {
        std::vector<Mover> out;
        const PathPoint p = at(scene.robot.path, travelled(scene.robot, t));
        out.push_back({p.position, speed_at(scene.robot, t) * p.direction, scene.robot_radius});
        for (const Vehicle& vehicle : scene.vehicles) add_movers(vehicle, t, out);
        return out;
    };
    return simulate_crowd(
        {scene.walkers, distance_field(scene.obstacles, scene.low, scene.high), movers}, duration);
}

inline const SceneEntry& entry(const std::string& name) {
    return *std::find_if(scene_table().begin(), scene_table().end(),
                         [&](const SceneEntry& e) { return e.name == name; });
}

inline void expect_path_free(const Scene& scene) {
    for (double t = 0.0; t < scene.duration; t += 0.1) {
        const auto p = at(scene.robot.path, travelled(scene.robot, t)).position;
        for (const Obstacle& obstacle : scene.obstacles) {
            ASSERT_GT(distance(obstacle, p), scene.robot_radius) << t << " s at " << p.transpose();
        }
    }
}

/// Vehicles drive through neither still things nor each other nor the robot.
inline void expect_traffic_free(const Scene& scene) {
    for (double t = 0.0; t < scene.duration; t += 0.2) {
        std::vector<std::vector<Mover>> all(scene.vehicles.size());
        for (std::size_t i = 0; i < all.size(); ++i) add_movers(scene.vehicles[i], t, all[i]);
        const PathPoint p = at(scene.robot.path, travelled(scene.robot, t));
        all.push_back({{p.position, p.direction, scene.robot_radius}});
        for (std::size_t i = 0; i < all.size(); ++i) {
            for (const Mover& a : all[i]) {
                for (std::size_t j = 0; j < i; ++j) {
                    for (const Mover& b : all[j]) {
                        ASSERT_GT((a.centre - b.centre).norm(), a.radius + b.radius)
                            << i << " " << j << " " << t;
                    }
                }
                for (const Obstacle& o : scene.obstacles)
                    ASSERT_GT(distance(o, a.centre), a.radius) << i << " " << t;
            }
        }
    }
}

/// Level beams would else graze the boundary between two layers of voxels, which no real sensor's
/// do.
inline void expect_off_boundaries(const Scene& scene) {
    for (const double height : {scene.sensor_height, scene.sensor_height + scene.floor}) {
        for (const double voxel : {0.1, 0.2}) {
            const double layers = height / voxel;
            EXPECT_GT(std::abs(layers - std::round(layers)) * voxel, 0.015) << height;
        }
    }
}

/// People keep out of walls, off each other and off the robot, at walking speed.
inline void expect_orderly(const Scene& scene, const Crowd& crowd, double duration,
                           double least_walking = 0.7) {
    const DistanceField field = distance_field(scene.obstacles, scene.low, scene.high);
    std::size_t samples = 0, in_wall = 0, overlaps = 0, fast = 0, walking = 0, at_robot = 0;
    for (double t = 0.0; t + 0.5 < duration; t += 0.5) {
        const auto robot = at(scene.robot.path, travelled(scene.robot, t)).position;
        for (std::size_t i = 0; i < crowd.walkers; ++i) {
            const Eigen::Vector2d p = stride_at(crowd, i, t).position.cast<double>();
            const Eigen::Vector2d q = stride_at(crowd, i, t + 0.5).position.cast<double>();
            const double speed = (q - p).norm() / 0.5;
            ++samples;
            walking += speed > 0.3;
            fast += speed > 1.8;
            in_wall += field.at(p).distance < 0.1;
            at_robot += (p - robot).norm() < scene.robot_radius + 0.15;
            for (std::size_t j = 0; j < i; ++j) {
                overlaps += (stride_at(crowd, j, t).position.cast<double>() - p).norm() < 0.3;
            }
        }
    }
    const auto share = [&](std::size_t count) {
        return static_cast<double>(count) / static_cast<double>(samples);
    };
    EXPECT_LT(share(in_wall), 0.002);
    EXPECT_LT(share(overlaps), 0.005);
    EXPECT_LT(share(fast), 0.002);
    EXPECT_LT(share(at_robot), 0.0005);
    EXPECT_GT(share(walking), least_walking);
}

}  // namespace dynamic_filter::sim
