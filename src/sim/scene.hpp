// SPDX-License-Identifier: MIT
/// The parts of a scene. To add a scene, write one file with a function that returns a Scene, and
/// add its line in scenes.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/bodies.hpp"
#include "sim/crowd.hpp"
#include "sim/mesh.hpp"
#include "sim/obstacles.hpp"
#include "sim/path.hpp"

namespace dynamic_filter::sim {

/// The parts that are near the robot at a time, and their placements at any time around it.
struct Surroundings {
    std::vector<Part> parts;
    std::function<Placements(double)> placements;
};

struct Scene {
    Mesh still;
    std::vector<Obstacle> obstacles;
    Eigen::Vector2d low, high;  ///< bounds of the area for people
    std::vector<Walker> walkers;
    std::vector<Vehicle> vehicles;
    Ride robot;                  ///< motion of the robot that carries the sensor
    double robot_radius = 0.4;   ///< [m] around the robot, which walkers keep clear
    double sensor_height = 0.8;  ///< [m]
    double duration = 0.0;       ///< [s]
    double floor = 0.0;  ///< [m] world height of z = 0, chosen off the boundaries of usual voxels
    /// Height of the ground; empty: zero everywhere.
    std::function<double(const Eigen::Vector2d&)> ground;
    /// Displacement at a time of people at a place (aboard a train); empty: none. The crowd itself
    /// is simulated without it.
    std::function<Eigen::Vector2d(const Eigen::Vector2d&, double)> carried;
    /// Of a scene that is too large to be cast as a whole: what is within a distance [m] of the
    /// robot at a time [s]. Its things are copies of `prototypes`. Empty: `still`, `walkers` and
    /// `vehicles` are the scene.
    std::function<Surroundings(double, double)> around;
    std::vector<Mesh> prototypes;
};

/// One of several drives through a scene.
struct Trip {
    double km = 1.0;
    int drive = 1;  ///< from 1
    int drives = 3;
};

struct SceneEntry {
    std::string name;
    int pedestrians = 0;  ///< default number
    double rate_hz = 10.0;
    int rounds = 0;  ///< of the robot within the duration; 0: its way has no rounds
    std::function<Scene(int pedestrians, std::uint64_t seed)> make;
    /// Of a scene with several drives; empty: it has none.
    std::function<Scene(int pedestrians, std::uint64_t seed, const Trip&)> make_trip = {};
};

const std::vector<SceneEntry>& scene_table();

}  // namespace dynamic_filter::sim
