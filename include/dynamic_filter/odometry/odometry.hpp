// SPDX-License-Identifier: MIT
/// @file
/// Where the sensor is, from its scans alone: each is registered to the map of those before.
///
/// - Units: [m], [rad], [s].
/// - Frames: world: that of the first scan's sensor.
/// - Shapes: times and labels are parallel to the points of their scan.
/// - Ownership: the points of the newest scan are kept until it is learned.
/// - Threads: single caller.
/// - Errors: none; see Tracked::status.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "dynamic_filter/odometry/config.hpp"
#include "dynamic_filter/odometry/motion.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// How far a pose can be relied on.
enum class TrackStatus {
    good,
    weak,  ///< in some direction, only the motion before says where the sensor is
    lost   ///< too little of the scan lies on the map: the pose goes on with the motion before
};

/// Where the sensor was, as far as the scans so far tell.
struct Tracked {
    Pose T_world_sensor = Pose::Identity();  ///< at the stamp
    Twist velocity = Twist::Zero();          ///< during the scan, in the sensor frame, per second
    TrackStatus status = TrackStatus::good;  ///< how far the pose can be relied on
    /// Of a displacement in the sensor frame since the scan before, [m] and [rad].
    Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
    double inliers = 1.0;      ///< 0..1: share of the points that lie on the map
    bool begins_anew = false;  ///< many scans were lost: a new map begins with this scan, and how
                               ///< it lies to the one before is not known
};

/// track() and learn() take turns, scan by scan. Same scans, same bits.
class Odometry {
public:
    explicit Odometry(const OdometryConfig& config);  ///< without a map
    Odometry(Odometry&&) noexcept;                    ///< the other one can only be destroyed
    Odometry& operator=(Odometry&&) noexcept;         ///< the other one can only be destroyed
    ~Odometry();

    /// Finds where the scan was taken. `times`, if not empty: when each point was measured, [s]
    /// from `stamp`; then the sensor's motion during the scan is undone. `guess`: the motion since
    /// the scan before, where something else measured it.
    Tracked track(const Points& points, std::span<const float> times, double stamp,
                  const std::optional<Pose>& guess = {});

    /// Adds the scan to the map, but for points labelled dynamic. Empty labels: all of it.
    void learn(const Labels& labels);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dynamic_filter
