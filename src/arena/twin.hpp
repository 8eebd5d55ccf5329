// SPDX-License-Identifier: MIT
/// Small simulated recordings in the layouts of public data sets: their names, classes,
/// calibration, stamps and frames. They show that the data are found and read as they should be;
/// their scores say nothing of the data sets. Each function writes one entry. Throws an Error.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/simulation.hpp"

namespace dynamic_filter::app {

/// sequences/NN: the scans of the window if the sequence has one, else the first 60.
void write_sequence_twin(const std::filesystem::path& root, const std::string& entry);
void write_dynamicmap_twin(const std::filesystem::path& root, const std::string& entry);
void write_helimos_twin(const std::filesystem::path& root, const std::string& entry);
void write_moe_twin(const std::filesystem::path& root, const std::string& entry);
void write_doals_twin(const std::filesystem::path& root, const std::string& entry);
/// Adds a scene to the tables that are there.
void write_nuscenes_twin(const std::filesystem::path& root, const std::string& entry);
void write_raw_twin(const std::filesystem::path& root, const std::string& entry);

/// The scans of a small crowd; another one for each entry.
std::vector<sim::SimulatedScan> twin_scans(const std::string& entry, std::size_t scans,
                                           const std::string& sensor = "vlp16");

/// x y z and further float32 fields; `values` has one list for each of these, parallel to the
/// points.
io::Cloud cloud_of(const Points& points, const std::vector<std::string>& more,
                   const std::vector<std::vector<float>>& values);

}  // namespace dynamic_filter::app
