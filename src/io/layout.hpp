// SPDX-License-Identifier: MIT
/// Where the files of a recording are.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/io/sequence.hpp"

namespace dynamic_filter::io {

using Paths = std::vector<std::filesystem::path>;

struct Layout {
    Format format = Format::folder;
    std::filesystem::path scan_folder;
    Paths scans;                        ///< in natural order; never empty
    std::vector<Pose> T_world_sensor;   ///< of the scans, where the layout itself says; else empty
    std::vector<double> stamps;         ///< [s] likewise
    std::filesystem::path pose_source;  ///< where T_world_sensor is from
    std::optional<std::filesystem::path> poses, times, calib, labels, truth_map;
    std::vector<std::string> notes;
};

/// Throws InputError when nothing usable is there, with what was looked for.
Layout find_layout(const std::filesystem::path& data, const OpenOptions& options);

/// True if a folder holds scans as files, in it or in one of the usual folders below.
bool has_scans(const std::filesystem::path& data);

/// The label file of each scan, an empty path for scans without; empty if no scan has one. What is
/// missing or belongs to no scan is told in `notes`: ground truth decides nothing.
Paths find_labels(const Layout& layout, std::vector<std::string>& notes);

}  // namespace dynamic_filter::io
