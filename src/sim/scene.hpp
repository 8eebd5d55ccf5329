// SPDX-License-Identifier: MIT
/// What a scene is made of. A new scene is one file with a function that returns a Scene, and its
/// line in scenes.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bodies.hpp"
#include "crowd.hpp"
#include "mesh.hpp"
#include "obstacles.hpp"
#include "path.hpp"

namespace dynamic_filter::sim {

struct Scene {
    Mesh still;
    std::vector<Obstacle> obstacles;
    Eigen::Vector2d low, high;  ///< where people can be
    std::vector<Walker> walkers;
    std::vector<Vehicle> vehicles;
    Ride robot;                  ///< carries the sensor
    double robot_radius = 0.4;   ///< [m] that walkers keep clear of
    double sensor_height = 0.8;  ///< [m]
    double duration = 0.0;       ///< [s]
    double floor = 0.0;          ///< [m] world height of z = 0: on no boundary of usual voxels
    std::function<double(const Eigen::Vector2d&)> ground;  ///< height; empty: zero everywhere
    /// How far those at a place are carried off at a time (aboard a train); empty: nowhere. The
    /// crowd is simulated as if they stayed.
    std::function<Eigen::Vector2d(const Eigen::Vector2d&, double)> carried;
};

struct SceneEntry {
    std::string name;
    int pedestrians = 0;  ///< unless asked otherwise
    double rate_hz = 10.0;
    int rounds = 0;  ///< that the robot goes within the duration; 0: its way is no round
    std::function<Scene(int pedestrians, std::uint64_t seed)> make;
};

const std::vector<SceneEntry>& scene_table();

}  // namespace dynamic_filter::sim
