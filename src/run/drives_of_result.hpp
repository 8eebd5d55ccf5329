// SPDX-License-Identifier: MIT
/// The recordings of a result, with the folders of their labels.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::app {

struct DriveOfResult {
    std::string name;
    std::filesystem::path recording;  ///< where the run found it
    std::filesystem::path folder;     ///< of its labels, maps and recording.json
};

/// `result`: the output folder of a run over one recording or several, or the map in it. An update
/// has those drives alone that it added. Throws
/// InputError if it is none or not complete, or if a recording is not there any more.
std::vector<DriveOfResult> drives_of_result(const std::filesystem::path& result);

/// The output folder of a run, given that or its map.
std::filesystem::path output_of(const std::filesystem::path& result);

/// True for the output of `run --update`, whose map has more drives than it labels.
bool is_of_update(const std::filesystem::path& result);

/// config.toml of the run whose labels are in the folder: of one recording, or of a drive, which is
/// OUT/drives/NAME. Empty if no run left it.
std::optional<std::filesystem::path> settings_file_of(const std::filesystem::path& folder);

/// False for a scan that the run left out.
bool has_labels(const std::filesystem::path& folder, const io::Recording& recording, std::size_t i);

/// The labels of scan i, of which the recording has `points`. Throws InputError, and ConfigError if
/// they are of another number of points.
Labels labels_of_scan(const std::filesystem::path& folder, const io::Recording& recording,
                      std::size_t i, std::size_t points);

}  // namespace dynamic_filter::app
