// SPDX-License-Identifier: MIT
#include "live/live_config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <set>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"

namespace dynamic_filter::live {

namespace {

void check_prefix(const LiveConfig& config) {
    const std::string& prefix = config.output.prefix;
    if (!prefix.starts_with('/') || prefix.ends_with('/')) {
        throw ConfigError(fmt::format(
            "setting 'output.prefix': '{}' must begin with a slash, and not end with one", prefix));
    }
}

void check_grid(const LiveConfig::Grid& grid) {
    constexpr double kMostCells = 4e6;
    const double across = 2.0 * grid.radius / grid.cell;
    if (across * across > kMostCells) {
        throw ConfigError(fmt::format(
            "settings 'grid.radius' and 'grid.cell': {:.1f} million cells; at most {:.0f} million "
            "are published",
            1e-6 * across * across, 1e-6 * kMostCells));
    }
    if (grid.robot_height <= grid.step) {
        throw ConfigError(
            fmt::format("setting 'grid.robot_height': {} must be greater than 'grid.step', {}",
                        grid.robot_height, grid.step));
    }
}

/// The sensors of a vehicle are linked by /tf alone.
void check_sensors(const LiveConfig& config) {
    const std::vector<std::string> topics = cloud_topics(config);
    if (topics.size() < 2) return;
    if (std::set<std::string>(topics.begin(), topics.end()).size() < topics.size()) {
        throw ConfigError("setting 'input.cloud': names a topic twice");
    }
    if (config.input.pose == "none") {
        throw ConfigError(
            "setting 'input.pose': the own odometry follows one sensor, and 'input.cloud' names "
            "several");
    }
    if (!config.input.mask.empty()) {
        throw ConfigError(
            "setting 'input.mask': is in the frame of one sensor, and 'input.cloud' names several");
    }
}

void use_domain_of_environment(LiveConfig& config) {
    const char* const domain = std::getenv("ROS_DOMAIN_ID");
    if (domain == nullptr || *domain == '\0') return;
    try {
        set(config, "bus.domain", domain);
    } catch (const ConfigError& error) {
        throw ConfigError(fmt::format("ROS_DOMAIN_ID: {}", error.what()));
    }
}

std::vector<settings::Row> rows_of_live(const LiveConfig& config) {
    std::vector<settings::Row> rows;
    visit_live(config, [&](const Setting& s, const auto& member) {
        rows.push_back(settings::row_of(s, member));
    });
    return rows;
}

}  // namespace

void set(LiveConfig& config, const std::string& key, const std::string& value) {
    settings::assign(config, key, value,
                     "`dynamicfilter live --settings` and `dynamicfilter config`");
}

void validate(const LiveConfig& config) {
    validate(config.filter);
    check_prefix(config);
    check_grid(config.grid);
    check_sensors(config);
}

std::vector<std::string> cloud_topics(const LiveConfig& config) {
    std::vector<std::string> topics;
    for (const std::string_view topic : io::split_tokens(config.input.cloud)) {
        topics.emplace_back(topic);
    }
    return topics;
}

LiveConfig load_live_config(const app::ConfigOptions& options,
                            std::vector<app::Assignment> parameters) {
    LiveConfig config;
    config.filter = preset(options.preset);
    use_domain_of_environment(config);
    std::ranges::move(app::assignments_of(options), std::back_inserter(parameters));
    app::assign_all(config, parameters);
    return config;
}

std::vector<std::string> changing_settings() {
    std::vector<std::string> keys;
    const LiveConfig config;
    visit(config, [&](const Setting& s, const auto&) {
        if (s.while_running) keys.emplace_back(s.key);
    });
    return keys;
}

void change(LiveConfig& config, const std::string& key, const std::string& value) {
    const auto keys = changing_settings();
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
        throw ConfigError(
            fmt::format("setting '{}' cannot change while the filter runs; these can: {}", key,
                        fmt::join(keys, ", ")));
    }
    set(config, key, value);
}

std::string to_toml(const LiveConfig& config) { return app::to_toml(rows_of_live(config)); }

}  // namespace dynamic_filter::live
