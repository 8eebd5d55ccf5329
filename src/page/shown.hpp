// SPDX-License-Identifier: MIT
/// The points of a run that its page has room for.
#pragma once

#include "page/run_view.hpp"
#include "page/thinned_cloud.hpp"

namespace dynamic_filter::app {

/// Room on the page: 30 MB, and what a browser draws.
constexpr std::size_t kMapPoints = 500'000, kFramePoints = 1'000'000, kFrames = 400;

/// All that the page shows of points.
struct Shown {
    ThinnedCloud map;
    std::vector<ShownPoint> frames{};          ///< frame by frame
    std::vector<std::uint32_t> frame_begin{};  ///< one more than frames
    std::vector<std::int32_t> frame_of_scan{};
    bool has_intensity = false;
};

/// Reads as many scans as the page has room for, evenly over the run. `origin`: of the page, in the
/// world.
Shown collect(const ViewInput& input, const Eigen::Vector3d& origin);

/// As recorded; empty where there is none.
std::vector<double> intensities(const io::Cloud& cloud);

}  // namespace dynamic_filter::app
