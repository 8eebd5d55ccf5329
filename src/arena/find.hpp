// SPDX-License-Identifier: MIT
/// Finds what an arena needs below the folder that the user gives.
#pragma once

#include "arena/arena.hpp"

namespace dynamic_filter::app {

/// The first of the folders that is there; nothing if none is.
std::optional<std::filesystem::path> first_folder(
    const std::vector<std::filesystem::path>& choices);

/// Scans by the numbers in their names: `first`, `first + step` and so on up to `last`.
struct ScanWindow {
    std::size_t first = 0, last = 0, step = 1;
};

/// ERASOR's window of a sequence of SemanticKITTI, if it has one; the last scan is included.
std::optional<ScanWindow> semantickitti_window(const std::string& sequence);

/// Chooses the scans of the window among those in `folder`, which may hold others. Throws
/// InputError with the first one that is missing.
void choose_window(DataOptions& data, const std::filesystem::path& folder,
                   const std::string& extension, const ScanWindow& window);

/// A sequence in the layout of SemanticKITTI, with the first of the pose files that is there.
/// Throws InputError without labels, calibration or poses.
std::optional<Trial> find_sequence(const std::filesystem::path& root, const std::string& sequence,
                                   const std::vector<std::string>& pose_files);

/// Throws InputError unless the recording has a scan for each row of its pose file: data sets come
/// in parts, and figures of some of them are not those of the whole.
void require_whole(const Trial& trial, const io::Recording& recording);

}  // namespace dynamic_filter::app
