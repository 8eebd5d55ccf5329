// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/settings.hpp"

namespace dynamic_filter::app {

struct ConfigOptions {
    std::string preset = "default";
    std::optional<std::filesystem::path> file;
    std::vector<std::string> assignments;  ///< "a.b=v"
    std::string assigned_by = "--set ";    ///< what errors call them
};

/// Preset, then file, then --set; checked. Throws ConfigError, also for a setting that has no
/// effect with the method in force.
Config load_config(const ConfigOptions& options);

/// A setting, and where the user wrote it.
struct Assigned {
    std::string key, where;
};

/// Adds an error for each setting of the filter that has no effect with the method in force.
void note_without_effect(const Config& config, const std::vector<Assigned>& assigned,
                         std::vector<std::string>& errors);

/// A value in a TOML file, as text.
struct FileSetting {
    std::string key, value;  ///< key with its section: "map.voxel_size"
    std::uint32_t line = 0;
};

/// All values of a TOML file. Throws ConfigError if it cannot be read or is not TOML.
std::vector<FileSetting> settings_of_toml(const std::filesystem::path& file);

/// Applies a TOML file; returns what it sets. Errors name the file, the line and, for unknown keys,
/// the nearest one.
std::vector<Assigned> apply_toml(Config& config, const std::filesystem::path& file);

/// Every setting in force with its unit, symbol and meaning as a comment; apply_toml reads it back.
std::string to_toml(const Config& config);

/// The same as data: an array of {key, value, min, max, unit, symbol, help}, inclusive bounds for
/// numbers only.
std::string to_json(const Config& config);

}  // namespace dynamic_filter::app
