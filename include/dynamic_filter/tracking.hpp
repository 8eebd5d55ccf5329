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
