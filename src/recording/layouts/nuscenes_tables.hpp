// SPDX-License-Identifier: MIT
/// The tables of nuScenes, which are arrays of JSON objects.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io::nuscenes {

/// Calls `use` with each entry of a table; throws InputError if an entry lacks a required value.
void each_entry(const std::filesystem::path& file,
                const std::function<void(const nlohmann::json& entry)>& use);

std::string text_of(const nlohmann::json& entry, const char* key);

/// The pose of its `translation` and `rotation`. `file`: for the message of an InputError.
Pose pose_of(const nlohmann::json& entry, const std::filesystem::path& file);

}  // namespace dynamic_filter::io::nuscenes
