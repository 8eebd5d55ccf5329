// SPDX-License-Identifier: MIT
/// What all tables of settings share. A table is a struct with a function visit(table, f), found by
/// its argument, which calls f(setting, member) for each of its members. So a setting is its member
/// and its row in visit(), and nothing else.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "dynamic_filter/settings.hpp"

namespace dynamic_filter::settings {

/// Where the settings of the filter are listed, for messages.
inline constexpr std::string_view kListedByConfig = "`dynamicfilter config`";

enum class Kind { flag, number, choice, text };

/// A setting and its value.
struct Row {
    Setting setting;
    Kind kind = Kind::text;
    std::string text;     ///< the value, as read_value() reads it
    double number = 0.0;  ///< of numbers; of a choice, the number of its word
};

// Read a value, and check its bounds. Throw ConfigError that says what was expected.
void read_value(const Setting& setting, std::string_view text, bool& value);
void read_value(const Setting& setting, std::string_view text, int& value);
void read_value(const Setting& setting, std::string_view text, double& value);
void read_value(const Setting& setting, std::string_view text, std::string& value);
/// The number of a word among the choices.
std::size_t read_choice(const Setting& setting, std::string_view text);
template <class Enum>
requires std::is_enum_v<Enum>
void read_value(const Setting& setting, std::string_view text, Enum& value) {
    value = static_cast<Enum>(read_choice(setting, text));
}

Row row_of(const Setting& setting, bool value);
Row row_of(const Setting& setting, int value);
Row row_of(const Setting& setting, std::size_t value);
Row row_of(const Setting& setting, double value);
Row row_of(const Setting& setting, const std::string& value);
Row row_of_choice(const Setting& setting, std::size_t value);
template <class Enum>
requires std::is_enum_v<Enum> Row row_of(const Setting& setting, Enum value) {
    return row_of_choice(setting, static_cast<std::size_t>(value));
}

template <class Table>
std::vector<Row> rows_of(const Table& table) {
    std::vector<Row> rows;
    visit(table, [&](const Setting& s, const auto& member) { rows.push_back(row_of(s, member)); });
    return rows;
}

/// Throws ConfigError that names the nearest key, or else says where all are listed.
[[noreturn]] void refuse_unknown(const std::vector<Row>& rows, std::string_view key,
                                 std::string_view listed_by);

/// Sets one member. Throws ConfigError if there is none, or if the value is wrong.
template <class Table>
void assign(Table& table, std::string_view key, std::string_view text,
            std::string_view listed_by = kListedByConfig) {
    bool found = false;
    visit(table, [&](const Setting& s, auto& member) {
        if (s.key != key) return;
        found = true;
        read_value(s, text, member);
    });
    if (!found) refuse_unknown(rows_of(table), key, listed_by);
}

/// The value of one member as text. Throws ConfigError if there is none.
template <class Table>
std::string value_of(const Table& table, std::string_view key,
                     std::string_view listed_by = kListedByConfig) {
    std::optional<std::string> text;
    visit(table, [&](const Setting& s, const auto& member) {
        if (s.key == key) text = row_of(s, member).text;
    });
    if (!text) refuse_unknown(rows_of(table), key, listed_by);
    return *text;
}

/// A sentence, if the value is a number out of bounds.
std::optional<std::string> out_of_bounds(const Row& row);

/// Whether the setting has an effect with the method that the rows name.
bool in_force(const std::vector<Row>& rows, const Setting& setting);
/// Says that it has none.
std::string has_no_effect(const std::vector<Row>& rows, const Setting& setting);
/// Throws ConfigError if it has none, or if there is no such setting.
void require_in_force(const std::vector<Row>& rows, std::string_view key);

}  // namespace dynamic_filter::settings
