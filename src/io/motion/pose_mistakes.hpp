// SPDX-License-Identifier: MIT
/// What is wrong with poses that do not fit their scans.
#pragma once

#include <string>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// The poses of scans in a row: as given, and as the scans show them.
struct TwoTracks {
    std::vector<double> stamps;  ///< [s], increasing
    std::vector<Pose> given, shown;
};

/// The mistake that explains best how the given poses differ from those shown, in a sentence with
/// figures: an offset in time, another frame than the sensor's, jitter, or drift.
std::string name_mistake(const std::vector<TwoTracks>& tracks);

/// The same where scans do not blur at the given poses: only an offset in time or another frame,
/// and only if that explains nearly all of a difference that is more than the odometry's own error.
/// Empty otherwise.
std::string name_constant_mistake(const std::vector<TwoTracks>& tracks);

}  // namespace dynamic_filter::io
