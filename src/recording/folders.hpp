// SPDX-License-Identifier: MIT
/// Lists the contents of folders.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "recording/layout.hpp"

namespace dynamic_filter::io {

bool is_folder(const std::filesystem::path& path);
bool present(const std::filesystem::path& path);
std::string extension_of(const std::filesystem::path& path);  ///< in lower case
/// Absolute path without ".", ".." and a slash at its end, so that file name and parent are
/// correct.
std::filesystem::path whole_path(const std::filesystem::path& path);

/// A path without a slash at its end.
std::filesystem::path without_slash(const std::filesystem::path& path);
/// The folder above, also of "." and "..".
std::filesystem::path parent_of(const std::filesystem::path& folder);
/// Names of the subfolders in which scans are looked for, in this order; "." is the folder itself.
const std::vector<std::string>& usual_scan_folders();

/// Files that are not hidden and have one of the extensions, in natural order.
Paths list_files(const std::filesystem::path& folder, const std::set<std::string>& extensions,
                 std::error_code& error);
/// The same, but throws InputError if the folder cannot be listed.
Paths list_files(const std::filesystem::path& folder, const std::set<std::string>& extensions);
Paths list_folders(const std::filesystem::path& folder);  ///< empty if the folder cannot be listed

}  // namespace dynamic_filter::io
