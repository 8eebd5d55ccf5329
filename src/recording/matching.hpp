// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dynamic_filter/poses.hpp"
#include "recording/layout.hpp"

namespace dynamic_filter::io {

/// A pose for each scan.
struct Match {
    std::vector<Pose> poses;
    std::vector<double> stamps;  ///< [s] of the scans; empty if they are not known
    std::string note;            ///< how scans and poses were matched, for the user
    /// [s] of poses that were matched by order although both have stamps.
    std::vector<double> pose_stamps{};
};

/// Stamps [s] of scans whose file names are times; empty if the names are no times, or if the times
/// do not increase.
std::vector<double> growing_times_in_names(const Paths& scans);

/// Matches by order if the numbers of scans and poses agree. Otherwise matches by time within 0.05
/// s, using `times` (may be empty) or file names that are times. Throws InputError with both
/// numbers.
Match match_poses(const Layout& layout, const PoseFile& file, const std::vector<double>& times);

}  // namespace dynamic_filter::io
