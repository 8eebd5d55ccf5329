// SPDX-License-Identifier: MIT
/// @file
/// LiDAR odometry: estimates the pose of the sensor from its scans alone. Each scan is registered
/// to the map of the previous scans.
///
/// - Units: [m], [rad], [s].
/// - Frames: the world frame is the sensor frame of the first scan.
/// - Shapes: times and labels are parallel to the points of their scan.
/// - Ownership: the points of the newest scan are kept until learn() is called.
/// - Threads: single caller.
/// - Errors: none; see Tracked::status.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

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

/// Call track() and learn() in turn for each scan. The same scans give bit-identical results.
class Odometry {
public:
    explicit Odometry(const OdometryConfig& config);  ///< starts without a map
    Odometry(Odometry&&) noexcept;             ///< the moved-from object can only be destroyed
    Odometry& operator=(Odometry&&) noexcept;  ///< the moved-from object can only be destroyed
    ~Odometry();

    /// Estimates the pose at which the scan was taken. `times`, if not empty: the time at which
    /// each point was measured, [s] relative to `stamp`; motion compensation is then done. `guess`:
    /// the motion since the previous scan, if another source measured it.
    Tracked track(const Points& points, std::span<const float> times, double stamp,
                  const std::optional<Pose>& guess = {});

    /// Adds the scan to the map, without the points that are labelled dynamic. With empty labels,
    /// all points are added.
    void learn(const Labels& labels);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dynamic_filter
