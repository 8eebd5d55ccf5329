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
          "poses that are given are taken as a first guess, and each scan is registered to the map",
          0, 0, o.refine);
    field("odometry.voxel", "m",
          "edge of the smallest voxels of the map that scans are registered to; it has voxels of "
          "2, 4 and 8 times this, too",
          0.05, 10, o.voxel);
    field("odometry.spacing", "m", "points of a scan that are registered lie so far apart", 0.05,
          10, o.spacing);
    field("odometry.points", "1", "most points of a scan that are registered", 100, 1e6, o.points);
    field("odometry.nearest", "m", "what is nearer to the sensor may be the vehicle itself", 0, 50,
          o.nearest);
    field("odometry.farthest", "m", "what is farther from the sensor is left out", 5, 1000,
          o.farthest);
    field("odometry.speed", "m/s", "at the start, the sensor moves no faster", 0.1, 300, o.speed);
    field("odometry.acceleration", "m/s^2",
          "how much the sensor's velocity may change: where scans do not show how far it went, "
          "this says how far it went on",
          0.1, 1000, o.acceleration);
    field("odometry.angular_acceleration", "deg/s^2", "the same for its turning", 1, 1e5,
          o.angular_acceleration);
    field("odometry.lost_below", "1",
          "if a smaller share of the scan's points lies on the map, the scan is lost", 0, 1,
          o.lost_below);
    field("odometry.usual_share", "1",
          "if the share is below this part of what it was in the scans before, the pose is sought "
          "in a wide area",
          0, 1, o.usual_share);
    field("odometry.return_over", "m",
          "refined poses return to the given ones over such a way: given ones are better in the "
          "long run",
          1, 1e6, o.return_over);
}

}  // namespace dynamic_filter
