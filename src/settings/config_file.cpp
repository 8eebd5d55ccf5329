// SPDX-License-Identifier: MIT
#include "settings/config_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>
#include <vector>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"

namespace dynamic_filter::app {

namespace {

std::string setting_text(const toml::node& node) {
    if (const auto* text = node.as_string()) return text->get();
    std::ostringstream out;
    node.visit([&](const auto& value) { out << value; });
    return out.str();
}

void set_noting(Config& config, const Assigned& setting, const std::string& value,
                std::vector<Assigned>& assigned, std::vector<std::string>& errors) {
    try {
        set(config, setting.key, value);
        assigned.push_back(setting);
    } catch (const ConfigError& error) {
        errors.push_back(fmt::format("{}: {}", setting.where, error.what()));
    }
}

void list_settings(const toml::table& table, const std::string& prefix,
                   std::vector<FileSetting>& settings) {
    for (const auto& [key, node] : table) {
        const std::string name = prefix + std::string(key.str());
        if (const auto* section = node.as_table()) {
            list_settings(*section, name + ".", settings);
        } else {
            settings.push_back({name, setting_text(node), node.source().begin.line});
        }
    }
}

/// toml++ has no limit to the depth of dotted keys, but the stack has.
std::string read_shallow(const std::filesystem::path& file) {
    constexpr std::ptrdiff_t kMostDots = 1000;  // `config` prints fewer than a hundred
    std::string text = io::read_file(file);
    if (std::count(text.begin(), text.end(), '.') <= kMostDots) return text;
    throw ConfigError(
        fmt::format("{}: holds more than {} dots; are these settings?", file.string(), kMostDots));
}

}  // namespace

std::vector<FileSetting> settings_of_toml(const std::filesystem::path& file) {
    std::vector<FileSetting> settings;
    try {
        list_settings(toml::parse(read_shallow(file)), "", settings);
    } catch (const toml::parse_error& error) {
        throw ConfigError(fmt::format("{} (line {}): not TOML: {}", file.string(),
                                      error.source().begin.line, error.description()));
    } catch (const InputError& error) {
        throw ConfigError(error.what());  // a missing configuration is a usage error
    }
    return settings;
}

std::vector<Assigned> apply_toml(Config& config, const std::filesystem::path& file) {
    std::vector<std::string> errors;
    std::vector<Assigned> assigned;
    for (const FileSetting& setting : settings_of_toml(file)) {
        set_noting(config, {setting.key, fmt::format("line {}", setting.line)}, setting.value,
                   assigned, errors);
    }
    if (!errors.empty()) {
        throw ConfigError(fmt::format("{}: {}", file.string(), fmt::join(errors, "\n  ")));
    }
    for (Assigned& a : assigned) a.where = fmt::format("{}: {}", file.string(), a.where);
    return assigned;
}

void note_without_effect(const Config& config, const std::vector<Assigned>& assigned,
                         std::vector<std::string>& errors) {
    for (const Assigned& a : assigned) {
        try {
            require_in_force(config, a.key);
        } catch (const ConfigError& error) {
            errors.push_back(fmt::format("{}: {}", a.where, error.what()));
        }
    }
}

/// Settings without an effect are reported last, because the method may be set in any of the
/// sources.
Config load_config(const ConfigOptions& options) {
    Config config = preset(options.preset);
    std::vector<Assigned> assigned;
    if (options.file) assigned = apply_toml(config, *options.file);
    std::vector<std::string> errors;
    for (const std::string& assignment : options.assignments) {
        const std::string where = options.assigned_by + assignment;
        const auto equals = assignment.find('=');
        if (equals == std::string::npos) {
            errors.push_back(where + ": expected section.key=value");
            continue;
        }
        set_noting(config, {assignment.substr(0, equals), where}, assignment.substr(equals + 1),
                   assigned, errors);
    }
    note_without_effect(config, assigned, errors);
    if (!errors.empty()) throw ConfigError(fmt::format("{}", fmt::join(errors, "\n  ")));
    validate(config);
    return config;
}

std::string to_toml(const Config& config) {
    std::string text, section;
    visit(config, [&](const Setting& setting, const auto& member) {
        if (!in_force(config, setting)) return;
        const auto dot = setting.key.find('.');
        const auto own =
            dot == std::string_view::npos ? std::string_view{} : setting.key.substr(0, dot);
        if (own != section) {
            section = own;
            text += fmt::format("\n[{}]\n", section);
        }
        const std::string value = get(config, setting.key);
        using Value = std::decay_t<decltype(member)>;
        const bool bare = std::is_same_v<Value, bool> || std::is_arithmetic_v<Value>;
        const std::string line =
            fmt::format("{} = {}", setting.key.substr(dot + 1), bare ? value : '"' + value + '"');
        text += fmt::format("{:<32} # {}", line, setting.help);
        if (setting.unit.size() > 1 || setting.unit == "m" || setting.unit == "s") {
            text += fmt::format(" [{}]", setting.unit);
        }
        if (!setting.symbol.empty()) text += fmt::format(" ({})", setting.symbol);
        text += '\n';
    });
    return text;
}

std::string to_json(const Config& config) {
    auto list = nlohmann::ordered_json::array();
    visit(config, [&](const Setting& setting, const auto& member) {
        if (!in_force(config, setting)) return;
        nlohmann::ordered_json entry{{"key", setting.key}};
        using Value = std::decay_t<decltype(member)>;
        if constexpr (std::is_arithmetic_v<Value>) {
            entry["value"] = member;
        } else {
            entry["value"] = get(config, setting.key);
        }
        if (setting.min < setting.max) {
            entry["min"] = setting.min;
            entry["max"] = setting.max;
        }
        entry["unit"] = setting.unit;
        entry["symbol"] = setting.symbol;
        entry["help"] = setting.help;
        list.push_back(std::move(entry));
    });
    return list.dump(2) + '\n';
}

}  // namespace dynamic_filter::app
