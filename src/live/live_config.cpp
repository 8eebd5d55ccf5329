// SPDX-License-Identifier: MIT
#include "live/live_config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cstdlib>

#include "base/edit_distance.hpp"
#include "dynamic_filter/error.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::live {

namespace {

[[noreturn]] void refuse(const LiveSetting& s, const std::string& value,
                         const std::string& expected) {
    throw ConfigError(fmt::format("setting '{}': '{}' is not {}", s.key, value, expected));
}

void parse(const LiveSetting& s, const std::string& value, bool& member) {
    if (value != "true" && value != "false") refuse(s, value, "true or false");
    member = value == "true";
}

void parse(const LiveSetting& s, const std::string& value, std::string& member) {
    const std::string choices = fmt::format(" {} ", s.choices);
    const bool known = choices.find(" " + value + " ") != std::string::npos && !value.empty();
    if (!s.choices.empty() && !known) refuse(s, value, fmt::format("one of: {}", s.choices));
    member = value;
}

template <class Number>
void parse(const LiveSetting& s, const std::string& value, Number& member) {
    Number parsed{};
    const char* const end = value.data() + value.size();
    const auto [stop, error] = std::from_chars(value.data(), end, parsed);
    const bool fits = error == std::errc{} && stop == end && static_cast<double>(parsed) >= s.min &&
                      static_cast<double>(parsed) <= s.max;
    if (!fits) {
        refuse(
            s, value,
            fmt::format("a {}number from {} to {}{}{}", std::is_integral_v<Number> ? "whole " : "",
                        s.min, s.max, s.unit.empty() ? "" : " ", s.unit));
    }
    member = parsed;
}

std::vector<std::string> all_keys(const LiveConfig& config) {
    std::vector<std::string> keys;
    visit_live(config, [&](const LiveSetting& s, const auto&) { keys.emplace_back(s.key); });
    visit(config.filter, [&](const Setting& s, const auto&) { keys.emplace_back(s.key); });
    return keys;
}

bool is_filters(const Config& config, const std::string& key) {
    bool found = false;
    visit(config, [&](const Setting& s, const auto&) { found |= s.key == key; });
    return found;
}

void check_prefix(const LiveConfig& config) {
    const std::string& prefix = config.output.prefix;
    if (!prefix.starts_with('/') || prefix.ends_with('/')) {
        throw ConfigError(fmt::format(
            "setting 'output.prefix': '{}' must begin with a slash, and not end with one", prefix));
    }
}

void take_domain_of_environment(LiveConfig& config) {
    const char* const domain = std::getenv("ROS_DOMAIN_ID");
    if (domain == nullptr || *domain == '\0') return;
    try {
        set(config, "bus.domain", domain);
    } catch (const ConfigError& error) {
        throw ConfigError(fmt::format("ROS_DOMAIN_ID: {}", error.what()));
    }
}

}  // namespace

void set(LiveConfig& config, const std::string& key, const std::string& value) {
    bool found = false;
    visit_live(config, [&](const LiveSetting& s, auto& member) {
        if (s.key != key) return;
        parse(s, value, member);
        found = true;
    });
    if (found) return;
    if (is_filters(config.filter, key)) return dynamic_filter::set(config.filter, key, value);
    const std::string nearest = nearest_word(key, all_keys(config));
    throw ConfigError(fmt::format(
        "unknown setting '{}'{}", key,
        nearest.empty() ? "; `dynamicfilter live --settings` and `dynamicfilter config` list them"
                        : fmt::format("; did you mean '{}'?", nearest)));
}

LiveConfig load_live_config(const LiveOptions& options,
                            const std::vector<std::pair<std::string, std::string>>& parameters) {
    LiveConfig config;
    config.filter = preset(options.preset);
    take_domain_of_environment(config);
    std::vector<std::string> errors;
    std::vector<app::Assigned> assigned;
    const auto apply = [&](const std::string& key, const std::string& value,
                           const std::string& where) {
        try {
            set(config, key, value);
            if (is_filters(config.filter, key)) assigned.push_back({key, where});
        } catch (const ConfigError& error) {
            errors.push_back(fmt::format("{}: {}", where, error.what()));
        }
    };
    for (const auto& [key, value] : parameters) apply(key, value, "parameter " + key);
    if (options.file) {
        for (const app::FileSetting& s : app::settings_of_toml(*options.file)) {
            apply(s.key, s.value, fmt::format("{}: line {}", options.file->string(), s.line));
        }
    }
    for (const std::string& assignment : options.assignments) {
        const auto equals = assignment.find('=');
        if (equals == std::string::npos) {
            errors.push_back("--set " + assignment + ": expected section.key=value");
        } else {
            apply(assignment.substr(0, equals), assignment.substr(equals + 1),
                  "--set " + assignment);
        }
    }
    app::note_without_effect(config.filter, assigned, errors);
    if (!errors.empty()) throw ConfigError(fmt::format("{}", fmt::join(errors, "\n  ")));
    validate(config.filter);
    check_prefix(config);
    return config;
}

std::vector<std::string> changing_settings() {
    std::vector<std::string> keys;
    const LiveConfig config;
    visit_live(config, [&](const LiveSetting& s, const auto&) {
        if (s.changes_while_running) keys.emplace_back(s.key);
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

std::string to_toml(const LiveConfig& config) {
    std::string text, section;
    visit_live(config, [&](const LiveSetting& s, const auto& member) {
        const auto dot = s.key.find('.');
        if (s.key.substr(0, dot) != section) {
            section = s.key.substr(0, dot);
            text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", section);
        }
        std::string value = fmt::format("{}", member);
        if constexpr (std::is_same_v<std::decay_t<decltype(member)>, std::string>) {
            value = '"' + value + '"';
        }
        text += fmt::format("{:<32} # {}", fmt::format("{} = {}", s.key.substr(dot + 1), value),
                            s.help);
        if (!s.unit.empty()) text += fmt::format(" [{}]", s.unit);
        if (!s.choices.empty()) text += fmt::format("; one of: {}", s.choices);
        text += '\n';
    });
    return text;
}

}  // namespace dynamic_filter::live
