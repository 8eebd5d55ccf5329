// SPDX-License-Identifier: MIT
/// @file
/// A scan onto the map: point-to-plane registration by iteratively reweighted least squares.
///
/// - Units: [m], [rad].
/// - Frames: points in the sensor's, poses T_map_sensor.
/// - Shapes: any number of points; 6 x 6 matrices are ordered as a Twist.
/// - Threads: pure functions; thread-safe.
/// - Errors: none; a scan that cannot be registered has no inliers.
#pragma once

#include "dynamic_filter/odometry/motion.hpp"
#include "dynamic_filter/odometry/surface_map.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

using Information = Eigen::Matrix<double, 6, 6>;

/// What is known before looking at the points.
struct PosePrior {
    Pose T_map_sensor = Pose::Identity();
    Information information = Information::Zero();  ///< of a displacement in the sensor frame
};

/// How a scan was registered.
struct Registration {
    Pose T_map_sensor = Pose::Identity();
    /// What the points say of a displacement in the sensor frame, without the prior.
    Information information = Information::Zero();
    double inliers = 0.0;  ///< 0..1: share of the points that lie on a surface of the map
    double mapped = 0.0;   ///< 0..1: share of the points where the map has a surface
};

/// Moves the points from `start` until they lie on the surfaces of the map, as far as the prior
/// lets them. At first, points up to `reach` [m] off a surface count; the reach shrinks from
/// iteration to iteration, down to what the surfaces' own roughness explains (graduated
/// non-convexity with the kernel of Geman and McClure).
Registration register_points(const SurfaceMap& map, const Points& points, const Pose& start,
                             const PosePrior& prior, double reach);

/// [m] How far the points lie off the surfaces of the map, and how rough those are: the geometric
/// mean of both together.
double blur_on_map(const SurfaceMap& map, const Points& points, const Pose& T_map_sensor);

}  // namespace dynamic_filter
