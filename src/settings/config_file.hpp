// SPDX-License-Identifier: MIT
/// Settings from files and from the command line, and as TOML and JSON. All tables are read and
/// written here.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/settings.hpp"
#include "settings/table.hpp"

namespace dynamic_filter::app {

struct ConfigOptions {
    std::string preset = "default";
    std::optional<std::filesystem::path> file{};
    std::vector<std::string> assignments{};  ///< "a.b=v"
    std::string assigned_by = "--set ";      ///< what errors call them
};

/// A value that a user gave a setting, and where.
struct Assignment {
    std::string key;                   ///< with its section: "map.voxel_size"
    std::optional<std::string> value;  ///< empty: there was no "="
    std::string where;
};

/// Those of the file, then those of the command line. Throws ConfigError if the file cannot be read
/// or is not TOML.
std::vector<Assignment> assignments_of(const ConfigOptions& options);

/// Calls set(key, value) for each assignment, and require_effect(key) for those that were set.
/// Throws ConfigError that names all mistakes and their places.
void assign_all(const std::vector<Assignment>& assignments,
                const std::function<void(const std::string&, const std::string&)>& set,
                const std::function<void(const std::string&)>& require_effect);

/// Changes a table by the assignments, and checks it. Throws ConfigError that names all mistakes,
/// also for a setting that has no effect with the method in force.
template <class Table>
void assign_all(Table& table, const std::vector<Assignment>& assignments) {
    assign_all(
        assignments,
        [&](const std::string& key, const std::string& value) { set(table, key, value); },
        [&](const std::string& key) { settings::require_in_force(settings::rows_of(table), key); });
    validate(table);
}

/// Preset, then file, then --set; checked. Throws ConfigError.
Config load_config(const ConfigOptions& options);

/// Every setting in force with its unit, symbol and meaning as a comment; load_config() reads it
/// back.
std::string to_toml(const std::vector<settings::Row>& rows);
std::string to_toml(const Config& config);

/// The same as data: an array of {key, value, min, max, unit, symbol, help}, inclusive bounds for
/// numbers only.
std::string to_json(const Config& config);

}  // namespace dynamic_filter::app
