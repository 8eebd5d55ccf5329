// SPDX-License-Identifier: MIT
/// The formats of clouds that are known. A new one is a file, and a row of registry.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/writers.hpp"

namespace dynamic_filter::io {

struct CloudFormat {
    std::string extension;  ///< in lower case, with the dot
    Cloud (*read)(const std::filesystem::path& file);
    Written (*write)(const std::filesystem::path& file, const Cloud& cloud);  ///< or nullptr
    bool is_scan;  ///< true: a scan of a recording may be such a file
    /// Throws InputError if the size [bytes] shows that the file is damaged; nullptr if it never
    /// does.
    void (*refuse_bad_size)(const std::filesystem::path& file, std::size_t bytes) = nullptr;
    bool is_named = true;  ///< false: messages do not offer it, because the reader refuses it
};

/// All rows, in the order in which messages name them.
const std::vector<CloudFormat>& cloud_formats();

/// The row for the extension of a file, in upper or lower case; nullptr if there is none.
const CloudFormat* cloud_format_of(const std::filesystem::path& file);

enum class Purpose { read, write };

/// The extensions for messages: ".pcd, .ply, ...".
std::string cloud_extensions(Purpose purpose);

/// The extensions of scans.
const std::set<std::string>& scan_extensions();

}  // namespace dynamic_filter::io
