// SPDX-License-Identifier: MIT
/// Several recordings of one world: the drives of a map.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"
#include "recording/data_options.hpp"

namespace dynamic_filter::app {

/// A recording, and its pose file if it is not the usual one.
struct DriveSource {
    std::filesystem::path recording;
    std::optional<std::filesystem::path> poses{};
};

struct Drive {
    std::string name;  ///< of its folder in the result
    io::Recording recording;
};

/// Whether there is a recording of that name.
bool is_there(const std::filesystem::path& recording);

/// The recordings, with each list (a .txt file) replaced by what it lists: one recording a line;
/// after a tab, its pose file. Empty lines and lines that begin with # are left out. Relative paths
/// start at the folder of the list. Throws InputError.
std::vector<DriveSource> expand(const std::vector<std::filesystem::path>& recordings);

/// The last part of each path; where two are the same, the part before is put in front; where that
/// does not help, a number is added.
std::vector<std::string> names_of(const std::vector<DriveSource>& sources);

/// How to read each recording. `how.poses` goes before the pose file in a list. Throws
/// ConfigError if a recording is given twice, or one pose file for several recordings.
std::vector<DataOptions> options_of(const std::vector<DriveSource>& sources,
                                    const DataOptions& how);

/// The same sources, each with the pose file that options_of() gives it.
std::vector<DriveSource> with_pose_files(const std::vector<DriveSource>& sources,
                                         const DataOptions& how);

/// Opens all drives; `how` says how to read each of them. Throws InputError and ConfigError, also
/// if one has no poses, because without poses the drives have no common world.
std::vector<Drive> open_drives(const std::vector<DriveSource>& sources, const DataOptions& how);

}  // namespace dynamic_filter::app
