// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "dynamic_filter/sim/simulation.hpp"

namespace dynamic_filter::app {

/// Simulates and writes a recording in KITTI's layout: velodyne, labels, poses.txt (of the LiDAR),
/// times.txt; of sweeps, PCD files in scans instead of velodyne. The folder exists. `quiet`: no
/// progress on stderr. Returns the number of points.
std::size_t write_simulation(const sim::SimulationOptions& options,
                             const std::filesystem::path& folder, bool quiet = false);

}  // namespace dynamic_filter::app
