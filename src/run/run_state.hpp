// SPDX-License-Identifier: MIT
/// The file .run in the folder of a result: what the run was begun with, and whether it is
/// complete. Whoever resumes a run must come with the same.
#pragma once

#include <optional>
#include <string>

#include <string_view>
#include <vector>

#include "base/output_folder.hpp"
#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::app {

/// Begins the line that says how many of the recordings are those of the run that was updated.
inline constexpr std::string_view kUpdateLine = "update of ";

/// What a run leaves.

const FolderFiles& result_files();

/// How many scans the recording has, the first and the last one, and their size.
std::string scans_text(const io::Recording& recording);
/// The recording: where it is, its scans and their size.
std::string state_of(const io::Recording& recording);

/// How many of the recordings have their labels in the run that was updated. Throws InputError.
std::size_t updated_drives(const std::filesystem::path& folder);
/// Begins the line that says how many voxels a tile may hold.
inline constexpr std::string_view kTilesLine = "tiles of ";
/// How many voxels a tile of the run may hold; empty: it had no tiles. Throws InputError.
std::optional<std::size_t> tile_voxels_of_run(const std::filesystem::path& folder);

/// Where the recordings of the run in the folder are, in its order; empty if it does not tell.
std::vector<std::filesystem::path> recordings_of_run(const std::filesystem::path& folder);

/// Throws ConfigError if the folder holds labels that no run left: they may be somebody's ground
/// truth, so they must not be overwritten.
void refuse_foreign_labels(const std::filesystem::path& folder);

void write_state(const OutputFolder& output, std::string_view state);
void write_complete(const OutputFolder& output, std::string_view state);

/// True if the folder holds a run, complete.
bool is_whole_run(const std::filesystem::path& folder);
/// True if the folder holds this run, complete.
bool is_complete(const std::filesystem::path& folder, std::string_view state);
/// True if the folder holds this run, incomplete.
bool is_begun(const std::filesystem::path& folder, std::string_view state);
/// Throws ConfigError if the folder holds another run, or something else.
void refuse_other_run(const OutputFolder& output, std::string_view state);

}  // namespace dynamic_filter::app
