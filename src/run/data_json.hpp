// SPDX-License-Identifier: MIT
/// How a recording is read, in files of a run.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "recording/data_options.hpp"

namespace dynamic_filter::app {

/// An absolute path, so that the file means the same wherever it is read.
std::string full_path(const std::filesystem::path& path);

/// All rows of visit_reading() that have a value.
nlohmann::ordered_json json_of(const DataOptions& options);
/// Throws ConfigError for values that no option has, and what nlohmann::json throws.
DataOptions data_options_of(const nlohmann::ordered_json& json);

}  // namespace dynamic_filter::app
