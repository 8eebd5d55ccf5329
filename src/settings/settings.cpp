// SPDX-License-Identifier: MIT
#include "dynamic_filter/settings.hpp"

#include "dynamic_filter/error.hpp"
#include "settings/table.hpp"

namespace dynamic_filter {

Config preset(std::string_view name) {
    if (name == "default") return Config{};
    if (name == "paper") {
        Config config;
        config.method = Method::submaps;
        config.keyframe = {.interval = 0.75, .distance = 1.0};
        config.map.occupancy_threshold = 0.35;
        return config;
    }
    throw ConfigError("unknown preset '" + std::string(name) + "'; choose default or paper");
}

void set(Config& config, std::string_view key, std::string_view value) {
    settings::assign(config, key, value);
}

std::string get(const Config& config, std::string_view key) {
    return settings::value_of(config, key);
}

bool in_force(const Config& config, const Setting& setting) {
    return (setting.methods & methods_of(config.method)) != 0;
}

void require_in_force(const Config& config, std::string_view key) {
    settings::require_in_force(settings::rows_of(config), key);
}

std::vector<std::string> violations(const Config& config) {
    const std::vector<settings::Row> rows = settings::rows_of(config);
    const std::vector<settings::Row> defaults = settings::rows_of(Config{});
    std::vector<std::string> found;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (auto fault = settings::out_of_bounds(rows[i])) found.push_back(std::move(*fault));
        const Setting& setting = rows[i].setting;
        if (!in_force(config, setting) && rows[i].text != defaults[i].text) {
            found.push_back(settings::has_no_effect(rows, setting));
        }
    }
    if (config.method == Method::submaps && !config.front_end.enabled && !config.back_end.enabled) {
        found.push_back(
            "front_end.enabled and back_end.enabled are both false: nothing would be done");
    }
    return found;
}

void validate(const Config& config) {
    const auto found = violations(config);
    if (found.empty()) return;
    std::string message = "the configuration is not valid:";
    for (const auto& line : found) message += "\n  " + line;
    throw ConfigError(message);
}

}  // namespace dynamic_filter
