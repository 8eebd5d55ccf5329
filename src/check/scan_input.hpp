// SPDX-License-Identifier: MIT
/// Scans of a recording as input of the odometry.
#pragma once

#include <optional>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::io {

/// Empty if the scan cannot be read.
inline std::optional<Scan> read_scan(const Recording& recording, std::size_t i) {
    try {
        FullScan scan = recording.read(i);
        return Scan{std::move(scan.points), scan.T_world_sensor,   scan.stamp, i,
                    scan.has_pose,          std::move(scan.times), scan.sensor};
    } catch (const InputError&) {
        return std::nullopt;
    }
}

}  // namespace dynamic_filter::io
