// SPDX-License-Identifier: MIT
/// What is in a folder.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <system_error>

#include "layout.hpp"

namespace dynamic_filter::io {

bool is_folder(const std::filesystem::path& path);
bool present(const std::filesystem::path& path);
std::string extension_of(const std::filesystem::path& path);  ///< in small letters
/// Absolute and without "." and "..", nor a slash at its end: its name and its parent are real
/// ones.
std::filesystem::path whole_path(const std::filesystem::path& path);

/// Visible files with one of the extensions, in natural order.
Paths list_files(const std::filesystem::path& folder, const std::set<std::string>& extensions,
                 std::error_code& error);
/// Throws InputError if the folder cannot be listed.
Paths list_files(const std::filesystem::path& folder, const std::set<std::string>& extensions);
Paths list_folders(const std::filesystem::path& folder);  ///< none if it cannot be listed

}  // namespace dynamic_filter::io
