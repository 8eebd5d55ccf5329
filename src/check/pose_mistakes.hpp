// SPDX-License-Identifier: MIT
/// Finds the mistake in poses that do not fit their scans.
#pragma once

#include <string>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Poses of consecutive scans: as given, and as estimated from the scans.
struct TwoTracks {
    std::vector<double> stamps;  ///< [s], increasing
    std::vector<Pose> given, shown;
};

/// Describes, in a sentence with measured values, the mistake that best explains the difference
/// between given and estimated poses: an offset in time, a frame other than that of the sensor,
/// jitter, or drift.
std::string name_mistake(const std::vector<TwoTracks>& tracks);

/// The same for scans that do not blur at the given poses. Only an offset in time or another frame
/// is possible then, and only if it explains nearly all of a difference that is larger than the
/// error of the odometry. Whether scans overlay better without it shows whether it is one.
struct ConstantMistake {
    std::string text;                       ///< empty: none
    std::vector<std::vector<Pose>> mended;  ///< the given poses without it, by track
};
ConstantMistake find_constant_mistake(const std::vector<TwoTracks>& tracks);

}  // namespace dynamic_filter::io
