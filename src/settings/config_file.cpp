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

void list_values(const toml::table& table, const std::string& section, const std::string& file,
                 std::vector<Assignment>& values) {
    for (const auto& [key, node] : table) {
        const std::string name = section + std::string(key.str());
        if (const auto* inner = node.as_table()) {
            list_values(*inner, name + ".", file, values);
        } else {
            values.push_back({name, setting_text(node),
                              fmt::format("{}: line {}", file, node.source().begin.line)});
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

void list_values(const std::filesystem::path& file, std::vector<Assignment>& values) {
    try {
        list_values(toml::parse(read_shallow(file)), "", file.string(), values);
    } catch (const toml::parse_error& error) {
        throw ConfigError(fmt::format("{} (line {}): not TOML: {}", file.string(),
                                      error.source().begin.line, error.description()));
    } catch (const InputError& error) {
        throw ConfigError(error.what());  // a missing configuration is a usage error
    }
}

/// A string of JSON is one of TOML, too.
std::string toml_string(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

bool is_bare(const settings::Row& row) {
    return row.kind == settings::Kind::flag || row.kind == settings::Kind::number;
}

std::string comment_of(const settings::Row& row) {
    const Setting& s = row.setting;
    std::string text(s.help);
    if (!s.unit.empty() && s.unit != "1") text += fmt::format(" [{}]", s.unit);
    if (!s.symbol.empty()) text += fmt::format(" ({})", s.symbol);
    if (row.kind == settings::Kind::text && !s.choices.empty()) {
        text += fmt::format("; one of: {}", s.choices);
    }
    return text;
}

}  // namespace

std::vector<Assignment> assignments_of(const ConfigOptions& options) {
    std::vector<Assignment> all;
    if (options.file) list_values(*options.file, all);
    for (const std::string& given : options.assignments) {
        const auto equals = given.find('=');
        std::optional<std::string> value;
        if (equals != std::string::npos) value = given.substr(equals + 1);
        all.push_back({given.substr(0, equals), std::move(value), options.assigned_by + given});
    }
    return all;
}

void assign_all(const std::vector<Assignment>& assignments,
                const std::function<void(const std::string&, const std::string&)>& set,
                const std::function<void(const std::string&)>& require_effect) {
    std::vector<std::string> mistakes;
    const auto noted = [&](const Assignment& a, const auto& work) {
        try {
            work();
            return true;
        } catch (const ConfigError& error) {
            mistakes.push_back(fmt::format("{}: {}", a.where, error.what()));
            return false;
        }
    };
    std::vector<const Assignment*> done;
    for (const Assignment& a : assignments) {
        const bool is_set = noted(a, [&] {
            if (!a.value) throw ConfigError("expected section.key=value");
            set(a.key, *a.value);
        });
        if (is_set) done.push_back(&a);
    }
    // Only now, because any of the assignments may choose the method.
    for (const Assignment* a : done) noted(*a, [&] { require_effect(a->key); });
    if (!mistakes.empty()) throw ConfigError(fmt::format("{}", fmt::join(mistakes, "\n  ")));
}

Config load_config(const ConfigOptions& options) {
    Config config = preset(options.preset);
    assign_all(config, assignments_of(options));
    return config;
}

std::string to_toml(const std::vector<settings::Row>& rows) {
    std::string text, section;
    for (const settings::Row& row : rows) {
        if (!settings::in_force(rows, row.setting)) continue;
        const std::string key(row.setting.key);
        const auto dot = key.find('.');
        const std::string own = dot == std::string::npos ? "" : key.substr(0, dot);
        if (own != section) {
            section = own;
            text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", section);
        }
        const std::string line = fmt::format("{} = {}", key.substr(dot + 1),
                                             is_bare(row) ? row.text : toml_string(row.text));
        text += fmt::format("{:<32} # {}\n", line, comment_of(row));
    }
    return text;
}

std::string to_toml(const Config& config) { return to_toml(settings::rows_of(config)); }

std::string to_json(const Config& config) {
    auto list = nlohmann::ordered_json::array();
    for (const settings::Row& row : settings::rows_of(config)) {
        const Setting& setting = row.setting;
        if (!in_force(config, setting)) continue;
        nlohmann::ordered_json entry{{"key", setting.key}};
        entry["value"] = is_bare(row) ? nlohmann::ordered_json::parse(row.text)
                                      : nlohmann::ordered_json(row.text);
        if (setting.min < setting.max) {
            entry["min"] = setting.min;
            entry["max"] = setting.max;
        }
        entry["unit"] = setting.unit;
        entry["symbol"] = setting.symbol;
        entry["help"] = setting.help;
        list.push_back(std::move(entry));
    }
    return list.dump(2) + '\n';
}

}  // namespace dynamic_filter::app
