// SPDX-License-Identifier: MIT
/// @file
/// Point-to-plane registration of a scan to the map by iteratively reweighted least squares.
///
/// - Units: [m], [rad].
/// - Frames: points in the sensor frame, poses T_map_sensor.
/// - Shapes: any number of points; rows of 6 x 6 matrices are ordered as a Twist.
/// - Threads: pure functions; thread-safe.
/// - Errors: none; a scan that cannot be registered has no inliers.
#pragma once

#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/types.hpp"
#include "tracking/surface_map.hpp"

namespace dynamic_filter {

using Information = Eigen::Matrix<double, 6, 6>;

/// Knowledge about the pose from other sources than the points.
struct PosePrior {
    Pose T_map_sensor = Pose::Identity();
    Information information = Information::Zero();  ///< of a displacement in the sensor frame
};

/// Result of a registration.
struct Registration {
    Pose T_map_sensor = Pose::Identity();
    /// Information of the points about a displacement in the sensor frame, without the prior.
    Information information = Information::Zero();
    double inliers = 0.0;  ///< 0..1: share of the points that lie on a surface of the map
    double mapped = 0.0;   ///< 0..1: share of the points in places where the map has a surface
};

/// Moves the points from `start` until they lie on the surfaces of the map, balanced against the
/// prior. In the first iteration, points up to `reach` [m] away from a surface count. The reach
/// then shrinks in each iteration down to a value that follows from the roughness of the surfaces.
/// (This is graduated non-convexity with the Geman-McClure kernel.)
Registration register_points(const SurfaceMap& map, const Points& points, const Pose& start,
                             const PosePrior& prior, double reach);

/// Blur [m] of the points on the map: the geometric mean over all points of the root of d^2 + v,
/// with the distance d of the point from the surface and the variance v of the surface (its
/// roughness). A point counts at most 0.5 m, also where the map has no surface.
double blur_on_map(const SurfaceMap& map, const Points& points, const Pose& T_map_sensor);

}  // namespace dynamic_filter
