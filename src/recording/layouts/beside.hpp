// SPDX-License-Identifier: MIT
/// Files that lie beside the scans under usual names, and poses that the user gives in place of
/// them.
#pragma once

#include <filesystem>
#include <optional>

#include "recording/layouts/layouts.hpp"

namespace dynamic_filter::io {

/// True if the user gave poses and did not name the layout. A layout that has its own poses is then
/// not recognised.
bool prefers_other_poses(const Place& place);

/// True if poses are given by the user; the scans then get these in place of the layout's own.
bool has_given_poses(Layout& layout, const Place& place);

std::optional<std::filesystem::path> if_exists(const std::filesystem::path& path);

/// Lists the scans of a layout that keeps them in one folder. Throws InputError if there are none.
Layout scans_in(const std::filesystem::path& folder, const char* extension, const char* layout);

/// The pose file of a folder: one of the usual names, or the only *.tum. Throws InputError if there
/// are several of these.
std::optional<std::filesystem::path> find_pose_file(const std::filesystem::path& folder);

/// Finds times.txt and labels/ in the first of the folders that has them.
void find_times_and_labels(Layout& layout, const Paths& folders);

}  // namespace dynamic_filter::io
