// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dynamic_filter/io/poses.hpp"
#include "layout.hpp"

namespace dynamic_filter::io {

/// A pose for each scan.
struct Match {
    std::vector<Pose> poses;
    std::vector<double> stamps;         ///< [s] of the scans, empty if nothing says
    std::string note;                   ///< how scans and poses were matched
    std::vector<double> pose_stamps{};  ///< [s] where matched by order though both have stamps
};

/// Stamps [s] of scans whose names are times; empty if they are not, or are in another order.
std::vector<double> growing_times_in_names(const Paths& scans);

/// By order if the numbers agree; otherwise by time, from `times` (may be empty) or from file names
/// that are time stamps, within 0.05 s. Throws InputError with both numbers.
Match match_poses(const Layout& layout, const PoseFile& file, const std::vector<double>& times);

}  // namespace dynamic_filter::io
