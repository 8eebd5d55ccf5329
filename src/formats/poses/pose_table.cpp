// SPDX-License-Identifier: MIT
#include "formats/poses/pose_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "dynamic_filter/error.hpp"
#include "formats/poses/rigid.hpp"

namespace dynamic_filter::io {
namespace {

enum Role : std::size_t { kX, kY, kZ, kQx, kQy, kQz, kQw, kTime, kNanoseconds, kRoles };

constexpr std::array<const char*, kRoles> role_names = {"x",  "y",  "z",         "qx",  "qy",
                                                        "qz", "qw", "timestamp", "nsec"};

/// The meaning of each column, and the factor that converts stamps to seconds.
struct PoseColumns {
    std::array<std::optional<std::size_t>, kRoles> of;
    std::size_t count = 0;
    double seconds = 1.0;
};

/// A column title: "#timestamp [ns]" becomes "timestamp" and "ns"; "p_RS_R_x [m]" becomes
/// "p_rs_r_x" and "m".
struct Title {
    std::string name, unit;
};

Title title_of(std::string_view cell) {
    std::string text = to_lower(cell);
    std::replace(text.begin(), text.end(), '(', '[');
    std::erase_if(
        text, [](char c) { return std::string_view("#%\" ])").find(c) != std::string_view::npos; });
    const std::size_t bracket = text.find('[');
    Title title{text.substr(0, bracket), ""};
    if (bracket != std::string::npos) title.unit = text.substr(bracket + 1);
    for (const char* unit : {"ns", "us", "ms", "s"}) {  // titles such as "timestamp_ns"
        const std::string suffix = std::string("_") + unit;
        if (!title.unit.empty() || !title.name.ends_with(suffix)) continue;
        title.name.resize(title.name.size() - suffix.size());
        title.unit = unit;
    }
    // `rostopic echo -p` writes whole nanoseconds.
    const bool is_of_rostopic = cell.starts_with("%") || title.name == "field.header.stamp";
    if (is_of_rostopic && title.unit.empty()) title.unit = "ns";
    return title;
}

/// The part of a message: of "field.pose.pose.position.x", "position.x".
std::optional<Role> role_in_message(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos) return std::nullopt;
    const std::string part = name.substr(0, dot), leaf = name.substr(dot + 1);
    const std::size_t axis = leaf.size() == 1 ? std::string_view("xyzw").find(leaf[0]) : 4;
    const bool is_turn = part.ends_with("orientation") || part.ends_with("rotation");
    const bool is_place = part.ends_with("position") || part.ends_with("translation");
    if (is_turn && axis < 4) return static_cast<Role>(kQx + axis);
    if (is_place && axis < 3) return static_cast<Role>(kX + axis);
    if (leaf == "stamp") return kTime;
    if (!part.ends_with("stamp")) return std::nullopt;
    if (leaf == "sec" || leaf == "secs") return kTime;
    if (leaf == "nsec" || leaf == "nsecs" || leaf == "nanosec") return kNanoseconds;
    return std::nullopt;
}

std::optional<Role> role_of(const std::string& name) {
    for (const char* known : {"timestamp", "stamp", "time", "t", "sec", "secs"}) {
        if (name == known) return kTime;
    }
    if (name == "nsec" || name == "nsecs") return kNanoseconds;
    for (std::size_t axis = 0; axis < 4; ++axis) {
        const std::string letter(1, "xyzw"[axis]);
        for (const char* prefix : {"q", "q_", "q_rs_", "quat_", "rot_", "orientation_", "r"}) {
            if (name == prefix + letter) return static_cast<Role>(kQx + axis);
        }
        for (const char* prefix :
             {"", "t", "p", "t_", "p_", "p_rs_r_", "pos_", "position_", "trans_"}) {
            const bool is_place = name == prefix + letter || name == prefix + letter + "_m";
            if (axis < 3 && is_place) return static_cast<Role>(kX + axis);
        }
    }
    return role_in_message(name);
}

double seconds_of(const std::string& unit, const Lines& lines) {
    if (unit.empty() || unit == "s") return 1.0;
    if (unit == "ms") return 1e-3;
    if (unit == "us") return 1e-6;
    if (unit == "ns") return 1e-9;
    lines.fail("the stamp's unit " + quote(unit) + " is unknown; expected s, ms, us or ns");
}

/// The titles of a line; where blanks part them, "time [s]" is one.
std::vector<std::string> titles_in(std::string_view line) {
    std::vector<std::string> titles;
    for (const std::string_view cell : cells_of(line)) {
        const bool is_unit = cell.starts_with('[') || cell.starts_with('(');
        const bool is_behind_mark = titles.size() == 1 && titles.front() == "#";
        if (!titles.empty() && (is_unit || is_behind_mark)) {
            titles.back() += cell;
        } else {
            titles.emplace_back(cell);
        }
    }
    return titles;
}

/// Stamps of messages are better than other times, such as those at which they were recorded.
bool is_better_time(const std::string& title, const std::string& other) {
    const auto names_stamp = [](const std::string& text) {
        return title_of(text).name.find("stamp") != std::string::npos;
    };
    return names_stamp(title) && !names_stamp(other);
}

/// Which columns the line names. Throws InputError if two of them stand for the same.
PoseColumns columns_in(std::string_view line, const Lines& lines) {
    PoseColumns columns;
    const std::vector<std::string> titles = titles_in(line);
    columns.count = titles.size();
    for (std::size_t i = 0; i < titles.size(); ++i) {
        const Title title = title_of(titles[i]);
        const auto role = role_of(title.name);
        if (!role) continue;
        if (const auto other = columns.of[*role]) {
            if (*role == kTime && is_better_time(titles[*other], titles[i])) continue;
            if (*role != kTime || !is_better_time(titles[i], titles[*other]))
                lines.fail("two columns of the header stand for " + quote(role_names[*role]));
        }
        columns.of[*role] = i;
        if (*role == kTime) columns.seconds = seconds_of(title.unit, lines);
    }
    return columns;
}

PoseColumns columns_of(std::string_view line, const Lines& lines) {
    PoseColumns columns = columns_in(line, lines);
    for (std::size_t role = kX; role <= kQw; ++role) {
        if (!columns.of[role]) {
            lines.fail(
                fmt::format("the header names no column '{}'; expected timestamp, x, y, "
                            "z, qx, qy, qz, qw in any order (angles are not read; convert them)",
                            role_names[role]));
        }
    }
    return columns;
}

std::array<bool, kRoles> roles_in(std::string_view line) {
    std::array<bool, kRoles> roles{};
    for (const std::string& title : titles_in(line)) {
        if (const auto role = role_of(title_of(title).name)) roles[*role] = true;
    }
    return roles;
}

/// True if words are titles: text has few words that are titles by chance.
bool are_titles(std::string_view line) {
    constexpr std::ptrdiff_t fewest = 3;
    const auto roles = roles_in(line);
    return std::count(roles.begin(), roles.end(), true) >= fewest;
}

/// True if a comment names stamps, positions and rotations of rows with `columns`.
bool names_columns(std::string_view comment, std::size_t columns) {
    const auto roles = roles_in(comment);
    return titles_in(comment).size() == columns &&
           std::all_of(roles.begin(), roles.begin() + kTime + 1, [](bool has) { return has; });
}

/// True for titles of the numbers of a matrix, also behind a stamp.
bool name_matrix(std::string_view line) {
    const auto roles = roles_in(line);
    const std::size_t columns = titles_in(line).size();
    const bool has_turn =
        std::any_of(roles.begin() + kQx, roles.begin() + kTime, [](bool has) { return has; });
    return !has_turn && (columns == 12 || columns == 13 || columns == 16 || columns == 17);
}

bool has_comma(std::string_view line) { return line.find(',') != std::string_view::npos; }

bool begins_with_number(std::string_view line) {
    const auto cells = cells_of(line);
    return !cells.empty() && parse_real(cells.front()).has_value();
}

/// The titles of rows whose first line is the current one, which may be their titles.
Titles titles_at(const Lines& lines, std::string_view comment, std::size_t of_comment) {
    const std::string_view line = trim(lines.line());
    if (!begins_with_number(line)) {
        if (name_matrix(line)) return {lines.number(), false};
        return {has_comma(line) || are_titles(line) ? lines.number() : 0};
    }
    const bool is_named = names_columns(comment, cells_of(line).size()) ||
                          (has_comma(line) && has_comma(comment) && are_titles(comment));
    return {is_named ? of_comment : 0};
}

std::array<double, kRoles> values_of(std::string_view line, const PoseColumns& columns,
                                     const Lines& lines) {
    const auto cells = cells_of(line);
    if (cells.size() != columns.count) {
        lines.fail(fmt::format("{} columns; the header names {}", cells.size(), columns.count));
    }
    std::array<double, kRoles> values{};
    for (std::size_t role = 0; role < kRoles; ++role) {
        if (!columns.of[role]) continue;
        const auto value = parse_real(cells[*columns.of[role]]);
        if (!value) lines.fail(quote(cells[*columns.of[role]]) + " is no number");
        values[role] = *value;
    }
    return values;
}

void append_row(PoseRows& rows, const std::array<double, kRoles>& v, const PoseColumns& columns,
                const Lines& lines) {
    if (columns.of[kTime]) {
        append_stamp(rows, v[kTime] * columns.seconds + v[kNanoseconds] * 1e-9, lines);
    }
    const bool finite = std::all_of(v.begin(), v.begin() + kTime,
                                    [](double value) { return std::isfinite(value); });
    rows.file.poses.push_back(
        finite ? pose_from_quaternion({v[kX], v[kY], v[kZ]},
                                      Eigen::Quaterniond(v[kQw], v[kQx], v[kQy], v[kQz]),
                                      "as the header names them", lines)
               : lost_pose());
}

}  // namespace

Titles find_titles(std::string_view text, const std::filesystem::path& file) {
    std::string_view comment;
    std::size_t of_comment = 0;
    Lines lines(text, file);
    while (lines.next()) {
        const std::string_view line = trim(lines.line());
        if (line.empty()) continue;
        if (line.front() != '#') return titles_at(lines, comment, of_comment);
        if (of_comment != 0 && !are_titles(line)) continue;
        comment = line;
        of_comment = lines.number();
    }
    return {are_titles(comment) ? of_comment : 0};
}

PoseRows read_pose_table(Lines& lines, std::size_t titles) {
    PoseRows rows;
    PoseColumns columns;
    while (lines.next()) {
        const std::string_view line = trim(lines.line());
        if (lines.number() == titles) {
            columns = columns_of(line, lines);
        } else if (!is_blank_or_comment(line)) {
            append_row(rows, values_of(line, columns, lines), columns, lines);
        }
    }
    return rows;
}

}  // namespace dynamic_filter::io
