// SPDX-License-Identifier: MIT
/// @file
/// Rigid motion at a constant rate, motion compensation (deskewing) of the points of a sweep, and
/// when a rotating sensor measured each point. These times are computed from the directions of the
/// points, and used where a recording has none.
///
/// - Units: [m], [rad], [s]. A Twist is a velocity if it is per second, otherwise a displacement.
/// - Frames: a twist is given in the moving frame; points are in the frame of the sensor, which
///   rotates about its z axis.
/// - Shapes: times are parallel to points.
/// - Ownership: values; times are borrowed for the call.
/// - Threads: pure functions; thread-safe.
/// - Errors: none.
#pragma once

#include <span>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Translation [m] or [m/s] first, then rotation vector [rad] or [rad/s].
using Twist = Eigen::Matrix<double, 6, 1>;

/// The displacement that results from a constant twist: the exponential map of SE(3).
Pose exp(const Twist& twist);
/// The inverse of exp(), for rotations of less than pi.
Twist log(const Pose& displacement);

/// Transforms points into another frame.
Points moved(const Points& points, const Pose& T_to_from);

/// Motion compensation: returns the points as if all had been measured at one moment. Each point
/// was measured `times` [s] after this moment by a sensor that moved at `velocity` in its own
/// frame. Points without a finite time are not moved.
Points undo_motion(const Points& points, std::span<const float> times, const Twist& velocity);

/// When the points of a scan were measured, as a rotating sensor does it.
struct Sweep {
    bool clockwise = false;  ///< direction of rotation, seen from above
    double seam = 0.0;       ///< [rad] azimuth at which a scan begins and ends
    double duration = 0.1;   ///< [s] of one scan; below 0: the sensor turned the other way
    /// True: the order of the points tells how far the sensor had turned, which may be more than
    /// one turn. False: their azimuths do, with the two values above, and a scan is one turn.
    bool in_order = false;
    /// [s] added to all times, also to those that the points themselves have. By half the duration,
    /// the moment to which times refer is the begin of a sweep, not its middle.
    double shift = 0.0;
};

/// Times [s] relative to the middle of the sweep, from -duration/2 to duration/2, plus the shift.
/// Points that are not measured have time 0, and so have all if they are not in order.
std::vector<float> sweep_times(const Points& points, const Sweep& sweep);

/// How reliable a pose is.
enum class TrackStatus {
    good,
    /// The scan leaves one direction undetermined; there, the previous motion is extrapolated.
    weak,
    lost  ///< too few points lie on the map; the pose extrapolates the previous motion
};

/// Estimated pose and motion of the sensor at one scan.
struct Tracked {
    Pose T_world_sensor = Pose::Identity();  ///< at the stamp of the scan
    Twist velocity = Twist::Zero();          ///< during the scan, in the sensor frame, per second
    TrackStatus status = TrackStatus::good;  ///< how reliable the pose is
    /// Covariance of the displacement since the previous scan, in the sensor frame, [m] and [rad].
    Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
    double inliers = 1.0;  ///< 0..1: share of the points that lie on the map
    /// True if many scans were lost: a new map begins with this scan, and its pose relative to the
    /// previous map is not known.
    bool begins_anew = false;
};

}  // namespace dynamic_filter
