// SPDX-License-Identifier: MIT
/// part.json in the folder of a part: how the recordings are read, so that `merge` needs nothing
/// but the parts.
#pragma once

#include <filesystem>
#include <vector>

#include "recording/drives.hpp"
#include "run/run.hpp"

namespace dynamic_filter::app {

inline constexpr const char* kPartFile = "part.json";

/// Part `part` of `parts`, counted from 1.
struct PartNumber {
    std::size_t part = 1, parts = 1;
};
/// Reads "I/N". Throws ConfigError.
PartNumber part_number_of(const std::string& text);

struct Part {
    PartNumber number;
    std::vector<DriveSource> sources;
    RunOptions run;  ///< how to read and what to write; the settings are in config.toml
};

void write_part(const std::filesystem::path& folder, const Part& part);
/// Throws InputError if the folder holds no part, or one of another version.
Part read_part(const std::filesystem::path& folder);

}  // namespace dynamic_filter::app
