// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "commands.hpp"
#include "dynamic_filter/config.hpp"

namespace dynamic_filter::app {

/// Preset, then file, then --set; checked. Throws ConfigError.
Config load_config(const ConfigOptions& options);

/// Applies a TOML file. Errors name the file, the line and, for unknown keys, the nearest one.
void apply_toml(Config& config, const std::filesystem::path& file);

/// Every setting with its unit, symbol and meaning as a comment; apply_toml reads it back.
std::string to_toml(const Config& config);

/// The same as data: an array of {key, value, min, max, unit, symbol, help}, inclusive bounds for
/// numbers only.
std::string to_json(const Config& config);

}  // namespace dynamic_filter::app
