// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include <vector>

#include "dynamic_filter/simulation.hpp"

namespace dynamic_filter::app {

/// Simulates and writes a recording in KITTI's layout: velodyne, labels, poses.txt (of the LiDAR),
/// times.txt; of sweeps, PCD files in scans instead of velodyne. The folder exists. `quiet`: no
/// progress on stderr. Returns the number of points. Of things that rest during the drive but are
/// absent from another, labels are 259 (SemanticKITTI's "moving other"), with the number of the
/// thing in the upper 16 bits. `with_knowable`: also the folder knowable, unless it is interrupted.
std::size_t write_simulation(const sim::SimulationOptions& options,
                             const std::filesystem::path& folder, bool quiet = false,
                             bool with_knowable = false);

/// One of the recordings that a simulation gives.
struct SimulatedRecording {
    sim::SimulationOptions options;
    std::filesystem::path folder;
};

/// The recordings of a scene: one in the folder, or one below it for each drive, "drive_1" and so
/// on, in scenes with several drives.
std::vector<SimulatedRecording> simulated_recordings(const sim::SimulationOptions& options,
                                                     const std::filesystem::path& folder);

}  // namespace dynamic_filter::app
