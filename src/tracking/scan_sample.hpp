// SPDX-License-Identifier: MIT
/// Samples of the points of a scan that cover the scan evenly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Points in the order of the scan, without motion compensation.
struct ScanSample {
    std::vector<std::uint32_t> chosen;  ///< indices of the points in the scan
    Points points;                      ///< parallel to `chosen`
    std::vector<float> times;           ///< parallel [s]; empty: all points were measured at once

    /// The points after motion compensation to the stamp of the scan, for a sensor of this
    /// velocity.
    [[nodiscard]] Points at_stamp(const Twist& velocity) const {
        return times.empty() ? points : undo_motion(points, times, velocity);
    }
};

/// Points for the map: one in each small voxel, within the range of the settings.
ScanSample sample_for_map(const Points& points, std::span<const float> times,
                          const OdometryConfig& config);

/// Points for the registration: one of the points for the map in each larger voxel.
ScanSample sample_for_registration(const ScanSample& of_map, const OdometryConfig& config);

/// The scan with its points for the map only. Odometry and overlay_blur() give the same results for
/// it, faster: for scans that are used several times.
Scan thinned_scan(const Scan& scan, const OdometryConfig& config);

/// The sample without points labelled dynamic; with empty labels, all points.
ScanSample without_dynamic(const ScanSample& sample, const Labels& labels);

}  // namespace dynamic_filter
