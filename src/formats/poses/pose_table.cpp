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

constexpr std::size_t matrix_columns = 13;

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
    std::erase_if(text, [](char c) { return c == '#' || c == '"' || c == ' ' || c == ']'; });
    const std::size_t bracket = text.find('[');
    Title title{text.substr(0, bracket), ""};
    if (bracket != std::string::npos) title.unit = text.substr(bracket + 1);
    for (const char* unit : {"ns", "us", "ms"}) {  // titles such as "timestamp_ns"
        const std::string suffix = std::string("_") + unit;
        if (!title.unit.empty() || !title.name.ends_with(suffix)) continue;
        title.name.resize(title.name.size() - suffix.size());
        title.unit = unit;
    }
    return title;
}

std::optional<Role> role_of(const std::string& name) {
    for (const char* known : {"timestamp", "stamp", "time", "t", "sec", "secs"}) {
        if (name == known) return kTime;
    }
    if (name == "nsec" || name == "nsecs") return kNanoseconds;
    for (std::size_t axis = 0; axis < 4; ++axis) {
        const std::string letter(1, "xyzw"[axis]);
        if (name == "q" + letter || name == "q_" + letter || name == "q_rs_" + letter) {
            return static_cast<Role>(kQx + axis);
        }
        for (const char* prefix : {"", "t", "p", "t_", "p_", "p_rs_r_", "pos_", "position_"}) {
            if (axis < 3 && name == prefix + letter) return static_cast<Role>(kX + axis);
        }
    }
    return std::nullopt;
}

double seconds_of(const std::string& unit, const Lines& lines) {
    if (unit.empty() || unit == "s") return 1.0;
    if (unit == "ms") return 1e-3;
    if (unit == "us") return 1e-6;
    if (unit == "ns") return 1e-9;
    lines.fail("the stamp's unit " + quote(unit) + " is unknown; expected s, ms, us or ns");
}

PoseColumns columns_of(std::string_view header, const Lines& lines) {
    PoseColumns columns;
    for (const auto cell : split_at(header, ',')) {
        const Title title = title_of(cell);
        if (const auto role = role_of(title.name)) {
            if (columns.of[*role])
                lines.fail("two columns of the CSV header stand for " + quote(role_names[*role]));
            columns.of[*role] = columns.count;
            if (*role == kTime) columns.seconds = seconds_of(title.unit, lines);
        }
        ++columns.count;
    }
    for (std::size_t role = kX; role <= kQw; ++role) {
        if (!columns.of[role]) {
            lines.fail(
                fmt::format("the CSV header names no column '{}'; expected timestamp, x, y, "
                            "z, qx, qy, qz, qw in any order",
                            role_names[role]));
        }
    }
    return columns;
}

std::array<double, kRoles> values_of(std::string_view line, const PoseColumns& columns,
                                     const Lines& lines) {
    const auto cells = split_at(line, ',');
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

void append_row(PoseFile& file, const std::array<double, kRoles>& v, const PoseColumns& columns,
                const Lines& lines) {
    if (columns.of[kTime]) {
        append_stamp(file, v[kTime] * columns.seconds + v[kNanoseconds] * 1e-9, lines);
    }
    const bool finite = std::all_of(v.begin(), v.begin() + kTime,
                                    [](double value) { return std::isfinite(value); });
    file.poses.push_back(
        finite ? pose_from_quaternion({v[kX], v[kY], v[kZ]},
                                      Eigen::Quaterniond(v[kQw], v[kQx], v[kQy], v[kQz]),
                                      "as the CSV header names them", lines)
               : lost_pose());
}

bool begins_with_number(std::string_view line) {
    return parse_real(split_at(line, ',').front()).has_value();
}

/// Reads a row of MulRan: nanoseconds and a row-major 3x4 matrix.
void append_matrix(PoseFile& file, std::string_view line, const Lines& lines) {
    const auto cells = split_at(line, ',');
    if (cells.size() != matrix_columns) {
        lines.fail(fmt::format(
            "{} columns and no header; a CSV of poses needs one that names its columns, such as "
            "timestamp,x,y,z,qx,qy,qz,qw, or has 13: nanoseconds and a 3x4 matrix row by row",
            cells.size()));
    }
    std::array<double, matrix_columns> v{};
    for (std::size_t i = 0; i < v.size(); ++i) {
        const auto value = parse_real(cells[i]);
        if (!value) lines.fail(quote(cells[i]) + " is no number");
        v[i] = *value;
    }
    append_stamp(file, v[0] * 1e-9, lines);
    const bool finite =
        std::all_of(v.begin(), v.end(), [](double value) { return std::isfinite(value); });
    file.poses.push_back(finite ? pose_from_rows(Eigen::Map<const Rows34>(v.data() + 1), lines)
                                : lost_pose());
}

}  // namespace

PoseFile read_pose_table(Lines& lines) {
    PoseFile file;
    // From the header: the first line with commas, also if it is a comment.
    std::optional<PoseColumns> columns;
    while (lines.next()) {
        const std::string_view line = trim(lines.line());
        const bool has_comma = line.find(',') != std::string_view::npos;
        if (!columns && has_comma && !begins_with_number(line)) {
            columns = columns_of(line, lines);
        } else if (line.empty() || line.front() == '#') {
            continue;
        } else if (columns) {
            append_row(file, values_of(line, *columns, lines), *columns, lines);
        } else {
            append_matrix(file, line, lines);
        }
    }
    return file;
}

}  // namespace dynamic_filter::io
