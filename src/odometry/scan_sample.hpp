// SPDX-License-Identifier: MIT
/// Some of a scan's points, evenly spread over what it saw.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dynamic_filter/odometry/config.hpp"
#include "dynamic_filter/odometry/motion.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Points in the order of the scan, as they were measured.
struct ScanSample {
    std::vector<std::uint32_t> chosen;  ///< their places in the scan
    Points points;                      ///< parallel
    std::vector<float> times;           ///< parallel [s], or empty: all at once

    /// As if all had been measured at the scan's stamp, by a sensor of this velocity.
    [[nodiscard]] Points at_stamp(const Twist& velocity) const {
        return times.empty() ? points : undo_motion(points, times, velocity);
    }
};

/// For the map: one point in each small voxel within the range of the settings.
ScanSample sample_for_map(const Points& points, std::span<const float> times,
                          const OdometryConfig& config);

/// For registration: of those, one in each larger voxel.
ScanSample sample_for_registration(const ScanSample& of_map, const OdometryConfig& config);

/// Without the points whose label is dynamic; empty labels: all.
ScanSample without_dynamic(const ScanSample& sample, const Labels& labels);

}  // namespace dynamic_filter
