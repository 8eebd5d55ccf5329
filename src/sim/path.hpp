// SPDX-License-Identifier: MIT
/// Smooth curves in the ground plane and how far something has come along one.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dynamic_filter::sim {

struct Path {
    std::vector<Eigen::Vector2d> points;
    std::vector<double> lengths;  ///< [m] from the start to each point
    bool closed = false;
};

struct PathPoint {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< unit vector
};

/// A uniform cubic B-spline of these corners: smooth to the second derivative, but it cuts corners.
/// An open path starts and ends at the outer corners; a closed one goes round.
Path smooth_path(const std::vector<Eigen::Vector2d>& corners, bool closed);

/// The straight pieces between these points.
Path polyline(std::vector<Eigen::Vector2d> points);

/// Two straights of length 2 * half_straight along x, joined by half circles; starts on the lower
/// straight at `start_x`, towards +x.
Path stadium(double half_straight, double radius, double start_x);

/// Beyond the ends of an open path: straight on.
PathPoint at(const Path& path, double s);

constexpr double log_step = 0.1;  ///< [s] between the entries of a log

/// How far something has come, as a simulation of traffic wrote it down.
struct Log {
    double from = 0.0;        ///< [s] time of the first entry
    std::vector<double> way;  ///< [m] along the path, every log_step
};

/// A ride at constant speed, with at most one stop (braking and starting at 1.5 m/s2).
struct Ride {
    Path path;
    double start = 0.0;      ///< [m] along the path at time 0
    double speed = 5.0;      ///< [m/s]
    double stop_at = -1.0;   ///< [m] along the path; below `start`: no stop
    double stop_time = 0.0;  ///< [s] of standing
    Log log = {};            ///< if it has entries, they tell the way, not speed and stop
};

/// When a ride with a stop comes to stand [s].
double halts_at(const Ride& ride);

double travelled(const Ride& ride, double t);

/// [m/s] Of a logged ride at that time, of others on the way between stops.
double speed_at(const Ride& ride, double t);

}  // namespace dynamic_filter::sim
