// SPDX-License-Identifier: MIT
/// @file
/// Settings of the odometry, which estimates poses for scans without poses and refines given poses.
///
/// - Units: visit_odometry() names the unit of each field.
/// - Ownership: texts of a Setting are string literals and stay valid for the whole program.
/// - Threads: plain data and pure functions; thread-safe.
/// - Errors: none.
#pragma once

#include "dynamic_filter/setting.hpp"

namespace dynamic_filter {

/// Settings of the odometry. visit_odometry() explains each of them.
struct OdometryConfig {
    bool refine = false;
    double voxel = 0.5;
    double spacing = 0.6;
    int points = 3000;
    double nearest = 1.5;
    double farthest = 100.0;
    double speed = 40.0;
    double acceleration = 8.0;
    double angular_acceleration = 350.0;
    double lost_below = 0.35;
    double usual_share = 0.85;
    double return_over = 500.0;
};

/// Calls f(setting, member) for every field, in the order of the struct.
template <class C, class F>
void visit_odometry(C& o, F&& f) {
    const auto field = [&](const char* key, const char* unit, const char* help, double min,
                           double max, auto& member) {
        f(Setting{key, unit, "", help, min, max}, member);
    };
    field("odometry.refine", "",
          "whether given poses are refined: each is then the first guess for a registration of its "
          "scan to the map",
          0, 0, o.refine);
    field("odometry.voxel", "m",
          "edge length of the smallest voxels of the map to which scans are registered; the map "
          "also has voxels of 2, 4 and 8 times this size",
          0.05, 10, o.voxel);
    field("odometry.spacing", "m", "distance between the points of a scan that are registered",
          0.05, 10, o.spacing);
    field("odometry.points", "1", "largest number of points of a scan that are registered", 100,
          1e6, o.points);
    field("odometry.nearest", "m",
          "points nearer to the sensor are not used, because they may lie on its own vehicle", 0,
          50, o.nearest);
    field("odometry.farthest", "m", "points farther from the sensor are not used", 5, 1000,
          o.farthest);
    field("odometry.speed", "m/s",
          "largest speed of the sensor; used until its velocity is known, and to limit a search in "
          "a wide area",
          0.1, 300, o.speed);
    field("odometry.acceleration", "m/s^2",
          "typical change of the velocity of the sensor; it limits the motion in directions in "
          "which the scans do not show it",
          0.1, 1000, o.acceleration);
    field("odometry.angular_acceleration", "deg/s^2",
          "typical change of the angular velocity of the sensor", 1, 1e5, o.angular_acceleration);
    field("odometry.lost_below", "1",
          "a scan is lost if a smaller share of its points lies on the map", 0, 1, o.lost_below);
    field("odometry.usual_share", "1",
          "if the share of points on the map falls below this part of its value in the previous "
          "scans, the pose is searched for in a wide area",
          0, 1, o.usual_share);
    field("odometry.return_over", "m",
          "refined poses return to the given poses over this distance, because given poses are "
          "more accurate over long distances",
          1, 1e6, o.return_over);
}

}  // namespace dynamic_filter
