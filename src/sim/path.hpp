// SPDX-License-Identifier: MIT
/// Smooth curves in the ground plane, and motion along them.
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

/// A uniform cubic B-spline of these corners. It is smooth to the second derivative, and does not
/// pass through the corners. An open path starts and ends at the outer corners; a closed one is
/// periodic.
Path smooth_path(const std::vector<Eigen::Vector2d>& corners, bool closed);

/// Straight segments between these points.
Path polyline(std::vector<Eigen::Vector2d> points);

/// Two straight segments of length 2 * half_straight along x, connected by half circles. It starts
/// on the lower segment at `start_x`, towards +x.
Path stadium(double half_straight, double radius, double start_x);

/// Point of a path; beyond the ends of an open path, it goes straight on.
PathPoint at(const Path& path, double s);

constexpr double log_step = 0.1;  ///< [s] between the entries of a log

/// Distance along a path over time, recorded by a simulation of traffic.
struct Log {
    double from = 0.0;        ///< [s] time of the first entry
    std::vector<double> way;  ///< [m] along the path, one entry per log_step
};

/// A motion at constant speed with at most one stop (braking and accelerating at 1.5 m/s2).
struct Ride {
    Path path;
    double start = 0.0;      ///< [m] along the path at time 0
    double speed = 5.0;      ///< [m/s]
    double stop_at = -1.0;   ///< [m] along the path; below `start`: no stop
    double stop_time = 0.0;  ///< [s] duration of the stop
    Log log = {};            ///< if not empty, it replaces speed and stop
};

/// Time [s] at which a ride with a stop comes to a halt.
double halts_at(const Ride& ride);

double travelled(const Ride& ride, double t);

/// [m/s] of a logged ride at that time; of other rides between stops.
double speed_at(const Ride& ride, double t);

}  // namespace dynamic_filter::sim
