// SPDX-License-Identifier: MIT
#include "settings/table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "base/edit_distance.hpp"
#include "dynamic_filter/error.hpp"

namespace dynamic_filter::settings {

namespace {

constexpr std::string_view kSwitch = "false true";

std::string in_quotes(std::string_view text) { return "'" + std::string(text) + "'"; }

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return words;
}

std::string listed(const std::vector<std::string_view>& words, const char* between) {
    std::string list;
    for (const std::string_view word : words)
        list += (list.empty() ? "" : between) + std::string(word);
    return list;
}

[[noreturn]] void reject(const Setting& s, std::string_view value, const std::string& expected) {
    throw ConfigError("setting " + in_quotes(s.key) + ": " + in_quotes(value) + " is not " +
                      expected);
}

std::size_t number_of_word(const Setting& s, std::string_view choices, std::string_view text) {
    const std::vector<std::string_view> words = words_of(choices);
    const auto found = std::find(words.begin(), words.end(), text);
    if (found == words.end()) reject(s, text, "one of " + listed(words, ", "));
    return static_cast<std::size_t>(found - words.begin());
}

template <class Number, class... Format>
std::string printed(Number value, Format... format) {
    std::array<char, 400> buffer{};  // fits the greatest double without exponent
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format...).ptr;
    return {buffer.data(), end};
}

/// With a point or an exponent, so that the text says that it is no whole number.
std::string print(double value) {
    std::string text = printed(value);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
}

std::string between_bounds(const Setting& s) {
    return " from " + printed(s.min, std::chars_format::fixed) + " to " +
           printed(s.max, std::chars_format::fixed) +
           (s.unit.empty() || s.unit == "1" ? "" : " " + std::string(s.unit));
}

bool within_bounds(const Setting& s, double value) {
    return value >= s.min && value <= s.max;  // false for NaN
}

template <class Number>
void read_number(const Setting& s, std::string_view text, const char* kind, Number& value) {
    Number parsed{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, parsed);
    if (error != std::errc{} || stop != end || !within_bounds(s, static_cast<double>(parsed))) {
        reject(s, text, kind + between_bounds(s));
    }
    value = parsed;
}

/// The methods in force: that of the setting "method", or all.
unsigned methods_in_force(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        if (row.setting.key == "method") {
            return methods_of(static_cast<Method>(static_cast<int>(row.number)));
        }
    }
    return kAllMethods;
}

std::vector<std::string_view> names_of_methods(const std::vector<Row>& rows, unsigned methods) {
    std::vector<std::string_view> names;
    for (const Row& row : rows) {
        if (row.setting.key != "method") continue;
        const std::vector<std::string_view> words = words_of(row.setting.choices);
        for (std::size_t m = 0; m < words.size(); ++m) {
            if ((methods & methods_of(static_cast<Method>(m))) != 0) names.push_back(words[m]);
        }
    }
    return names;
}

/// How far a key is from the one that a user gave. Of keys at equal distance, the one whose whole
/// text is nearer is meant.
std::pair<std::size_t, std::size_t> distance(std::string_view given, std::string_view key) {
    const std::size_t whole = edit_distance(given, key);
    // A user may have left out the section, or have named another one.
    const std::string_view name = key.substr(key.find('.') + 1);
    std::size_t d = std::min(whole, edit_distance(given, name) + 1);
    if (name.starts_with(given)) d = std::min<std::size_t>(d, 2);
    if (name == given.substr(given.rfind('.') + 1)) d = std::min<std::size_t>(d, 1);
    return {d, whole};
}

}  // namespace

void read_value(const Setting& setting, std::string_view text, bool& value) {
    value = number_of_word(setting, kSwitch, text) == 1;
}

void read_value(const Setting& setting, std::string_view text, int& value) {
    read_number(setting, text, "a whole number", value);
}

void read_value(const Setting& setting, std::string_view text, double& value) {
    read_number(setting, text, "a number", value);
}

void read_value(const Setting& setting, std::string_view text, std::string& value) {
    if (!setting.choices.empty()) read_choice(setting, text);
    value = text;
}

std::size_t read_choice(const Setting& setting, std::string_view text) {
    return number_of_word(setting, setting.choices, text);
}

Row row_of(const Setting& setting, bool value) {
    return {setting, Kind::flag, value ? "true" : "false", 0.0};
}

Row row_of(const Setting& setting, int value) {
    return {setting, Kind::number, printed(value), static_cast<double>(value)};
}

Row row_of(const Setting& setting, std::size_t value) {
    return {setting, Kind::number, printed(value), static_cast<double>(value)};
}

Row row_of(const Setting& setting, double value) {
    return {setting, Kind::number, print(value), value};
}

Row row_of(const Setting& setting, const std::string& value) {
    return {setting, Kind::text, value, 0.0};
}

Row row_of_choice(const Setting& setting, std::size_t value) {
    return {setting, Kind::choice, std::string(words_of(setting.choices)[value]),
            static_cast<double>(value)};
}

void refuse_unknown(const std::vector<Row>& rows, std::string_view key,
                    std::string_view listed_by) {
    std::string_view nearest;
    // Keys at this distance or farther are no suggestion.
    std::pair<std::size_t, std::size_t> least(std::max<std::size_t>(3, key.size() / 2), 0);
    for (const Row& row : rows) {
        if (row.setting.key.starts_with(std::string(key) + ".")) {
            throw ConfigError(in_quotes(key) + " is a section: name a setting in it");
        }
        const auto here = distance(key, row.setting.key);
        if (here >= least) continue;
        least = here;
        nearest = row.setting.key;
    }
    throw ConfigError("unknown setting " + in_quotes(key) + "; " +
                      (nearest.empty() ? "see " + std::string(listed_by)
                                       : "did you mean " + in_quotes(nearest) + "?"));
}

std::optional<std::string> out_of_bounds(const Row& row) {
    const Setting& s = row.setting;
    if (row.kind != Kind::number || within_bounds(s, row.number)) return std::nullopt;
    return std::string(s.key) + " = " + row.text + " is outside " + print(s.min) + " .. " +
           print(s.max);
}

bool in_force(const std::vector<Row>& rows, const Setting& setting) {
    return (setting.methods & methods_in_force(rows)) != 0;
}

std::string has_no_effect(const std::vector<Row>& rows, const Setting& setting) {
    const auto names = names_of_methods(rows, setting.methods);
    const auto own = names_of_methods(rows, methods_in_force(rows));
    return "setting " + in_quotes(setting.key) + " belongs to the " +
           (names.size() > 1 ? "methods " : "method ") + in_quotes(listed(names, "' and '")) +
           "; it has no effect with the method " + in_quotes(listed(own, "")) +
           ": leave it out, or set `method` (preset \"paper\" is the method 'submaps')";
}

void require_in_force(const std::vector<Row>& rows, std::string_view key) {
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.setting.key == key; });
    if (row == rows.end()) refuse_unknown(rows, key, kListedByConfig);
    if (!in_force(rows, row->setting)) throw ConfigError(has_no_effect(rows, row->setting));
}

}  // namespace dynamic_filter::settings
