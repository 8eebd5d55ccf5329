// SPDX-License-Identifier: MIT
#include "dynamic_filter/settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/edit_distance.hpp"
#include "dynamic_filter/error.hpp"

namespace dynamic_filter {

namespace {

constexpr std::array<std::string_view, 3> kMethods{"scans", "submaps", "removert"};
constexpr std::array<std::string_view, 3> kRevertings{"map", "visibility", "none"};
constexpr std::array<std::string_view, 2> kMapTimes{"always", "latest"};
constexpr std::array<std::string_view, 2> kSwitch{"false", "true"};

/// The names of a choice, in the order of its enumerators.
constexpr const auto& words(Method) { return kMethods; }
constexpr const auto& words(Reverting) { return kRevertings; }
constexpr const auto& words(MapTime) { return kMapTimes; }
constexpr const auto& words(bool) { return kSwitch; }

template <class T>
constexpr bool is_number = std::is_same_v<T, int> || std::is_same_v<T, double>;

std::string in_quotes(std::string_view text) { return "'" + std::string(text) + "'"; }

[[noreturn]] void reject(std::string_view key, std::string_view value,
                         const std::string& expected) {
    throw ConfigError("setting " + in_quotes(key) + ": " + in_quotes(value) + " is not " +
                      expected);
}

template <class T>
void parse(std::string_view key, std::string_view text, T& value) {
    if constexpr (is_number<T>) {
        T parsed{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
        if (error != std::errc{} || end != text.data() + text.size()) {
            reject(key, text, std::is_same_v<T, int> ? "a whole number" : "a number");
        }
        value = parsed;
    } else {
        const auto& choices = words(value);
        const auto it = std::find(choices.begin(), choices.end(), text);
        if (it == choices.end()) {
            std::string list;
            for (const auto choice : choices)
                list += (list.empty() ? "" : ", ") + std::string(choice);
            reject(key, text, "one of " + list);
        }
        value = static_cast<T>(it - choices.begin());
    }
}

template <class T>
std::string print(const T& value) {
    if constexpr (is_number<T>) {
        std::array<char, 32> buffer{};
        const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
        std::string text(buffer.data(), end);
        if (std::is_same_v<T, double> && text.find_first_of(".en") == std::string::npos)
            text += ".0";
        return text;
    } else {
        return std::string(words(value)[static_cast<std::size_t>(value)]);
    }
}

[[noreturn]] void unknown_key(std::string_view key) {
    std::string_view nearest;
    // Keys at this distance or farther are no suggestion. Among keys at equal distance, the one
    // with the most similar whole key wins.
    std::pair<std::size_t, std::size_t> best(std::max<std::size_t>(3, key.size() / 2), 0);
    bool is_section = false;
    Config config;
    visit(config, [&](const Setting& s, const auto&) {
        is_section |= s.key.starts_with(std::string(key) + ".");
        // A user may have left out the section of the key.
        const auto name = s.key.substr(s.key.find('.') + 1);
        // The user may have named another section.
        const auto own_name = key.substr(key.rfind('.') + 1);
        const std::size_t whole = edit_distance(key, s.key);
        std::size_t d = std::min(whole, edit_distance(key, name) + 1);
        if (name.starts_with(key)) d = std::min<std::size_t>(d, 2);
        if (name == own_name) d = std::min<std::size_t>(d, 1);
        if (std::pair(d, whole) < best) {
            best = {d, whole};
            nearest = s.key;
        }
    });
    if (is_section) throw ConfigError(in_quotes(key) + " is a section: name a setting in it");
    if (nearest.empty())
        throw ConfigError("unknown setting " + in_quotes(key) + "; see `dynamicfilter config`");
    throw ConfigError("unknown setting " + in_quotes(key) + "; did you mean " + in_quotes(nearest) +
                      "?");
}

std::string methods_in_words(unsigned methods) {
    std::string list;
    for (std::size_t m = 0; m < kMethods.size(); ++m) {
        if ((methods & methods_of(static_cast<Method>(m))) == 0) continue;
        list += (list.empty() ? "" : " and ") + in_quotes(kMethods[m]);
    }
    return list;
}

std::string has_no_effect(const Config& config, const Setting& setting) {
    const bool several = (setting.methods & (setting.methods - 1)) != 0;
    return "setting " + in_quotes(setting.key) + " belongs to the " +
           (several ? "methods " : "method ") + methods_in_words(setting.methods) +
           "; it has no effect with the method " + in_quotes(print(config.method)) +
           ": leave it out, or set `method` (preset \"paper\" is the method 'submaps')";
}

}  // namespace

Config preset(std::string_view name) {
    if (name == "default") return Config{};
    if (name == "paper") {
        Config config;
        config.method = Method::submaps;
        config.keyframe = {.interval = 0.75, .distance = 1.0};
        config.map.occupancy_threshold = 0.35;
        return config;
    }
    throw ConfigError("unknown preset " + in_quotes(name) + "; choose default or paper");
}

void set(Config& config, std::string_view key, std::string_view value) {
    bool found = false;
    visit(config, [&](const Setting& s, auto& member) {
        if (s.key != key) return;
        found = true;
        parse(key, value, member);
    });
    if (!found) unknown_key(key);
}

std::string get(const Config& config, std::string_view key) {
    std::optional<std::string> text;
    visit(config, [&](const Setting& s, const auto& member) {
        if (s.key == key) text = print(member);
    });
    if (!text) unknown_key(key);
    return *text;
}

bool in_force(const Config& config, const Setting& setting) {
    return (setting.methods & methods_of(config.method)) != 0;
}

void require_in_force(const Config& config, std::string_view key) {
    bool found = false;
    visit(config, [&](const Setting& s, const auto&) {
        if (s.key != key) return;
        found = true;
        if (!in_force(config, s)) throw ConfigError(has_no_effect(config, s));
    });
    if (!found) unknown_key(key);
}

std::vector<std::string> violations(const Config& config) {
    const Config defaults;
    std::vector<std::string> found;
    visit(config, [&](const Setting& s, const auto& member) {
        if constexpr (is_number<std::decay_t<decltype(member)>>) {
            const auto value = static_cast<double>(member);
            if (!(value >= s.min && value <= s.max)) {  // also true for NaN
                found.push_back(std::string(s.key) + " = " + print(member) + " is outside " +
                                print(s.min) + " .. " + print(s.max));
            }
        }
        if (!in_force(config, s) && print(member) != get(defaults, s.key)) {
            found.push_back(has_no_effect(config, s));
        }
    });
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
