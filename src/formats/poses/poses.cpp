// SPDX-License-Identifier: MIT
#include "dynamic_filter/poses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "base/input.hpp"
#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/poses/pose_table.hpp"
#include "formats/poses/rigid.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::size_t kitti_columns = 12, tum_columns = 8, stamped_columns = 13;

std::vector<double> numbers(std::string_view line, const Lines& lines) {
    std::vector<double> row;
    for (const auto token : split_tokens(line)) {
        const auto value = parse_real(token);
        if (!value) lines.fail(quote(token) + " is no number; expected a row of a pose file");
        row.push_back(*value);
    }
    return row;
}

[[noreturn]] void explain_columns(std::size_t columns, const Lines& lines) {
    std::string hint =
        "expected 12 (KITTI, 3x4 row by row), 13 (the same after a stamp or an index) or 8 (TUM: t "
        "x y z qx qy qz qw)";
    if (columns == 16) hint += "; 16 look like a 4x4 matrix: keep the first 12";
    if (columns == 7) hint += "; 7 look like TUM without its stamp: put one first";
    if (columns == 17) hint += "; 17 look like a 4x4 matrix after an index: keep columns 2 to 13";
    lines.fail(fmt::format("{} columns; {}", columns, hint));
}

bool is_finite(const std::vector<double>& row) {
    return std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); });
}

/// `first`: column of the first number of the matrix.
Pose kitti_pose(const std::vector<double>& row, std::size_t first, const Lines& lines) {
    if (!is_finite(row)) return lost_pose();
    return pose_from_rows(Eigen::Map<const Rows34>(row.data() + first), lines);
}

/// True if the stamps only count the rows, from any whole number.
bool are_indices(const std::vector<double>& stamps) {
    constexpr double first_time = 1e8;  // larger whole numbers are times
    for (std::size_t i = 0; i < stamps.size(); ++i) {
        if (stamps[i] != stamps[0] + static_cast<double>(i)) return false;
    }
    return stamps.size() > 1 && stamps[0] == std::floor(stamps[0]) && stamps[0] < first_time;
}

Pose tum_pose(const std::vector<double>& row, const Lines& lines) {
    if (!std::isfinite(row[0])) lines.fail("the stamp is not finite");
    if (!is_finite(row)) return lost_pose();
    return pose_from_quaternion({row[1], row[2], row[3]},
                                Eigen::Quaterniond(row[7], row[4], row[5], row[6]),
                                "t x y z qx qy qz qw (xyzw)", lines);
}

PoseFile read_rows(Lines& lines) {
    PoseFile file;
    std::size_t columns = 0;
    while (lines.next()) {
        const std::string_view line = trim(lines.line());
        if (is_blank_or_comment(line)) continue;
        const std::vector<double> row = numbers(line, lines);
        if (columns == 0) columns = row.size();
        if (row.size() != columns) {
            lines.fail(fmt::format("{} columns; the rows before have {}", row.size(), columns));
        }
        if (columns == kitti_columns) {
            file.poses.push_back(kitti_pose(row, 0, lines));
        } else if (columns == stamped_columns) {
            file.poses.push_back(kitti_pose(row, 1, lines));
            append_stamp(file, row[0], lines);
        } else if (columns == tum_columns) {
            file.poses.push_back(tum_pose(row, lines));
            append_stamp(file, row[0], lines);
        } else {
            explain_columns(columns, lines);
        }
    }
    if (columns == stamped_columns && are_indices(file.stamps)) file.stamps.clear();
    return file;
}

/// Decides by the first line of data, because comments may contain commas in any file.
bool is_csv(const std::string& text, const std::filesystem::path& file) {
    Lines lines(text, file);
    bool comment_has_comma = false;
    while (lines.next()) {
        const std::string_view line = trim(lines.line());
        const bool has_comma = line.find(',') != std::string_view::npos;
        if (!is_blank_or_comment(line)) return has_comma;
        comment_has_comma = comment_has_comma || has_comma;
    }
    return comment_has_comma;
}

bool is_g2o(const std::string& text, const std::filesystem::path& file) {
    Lines lines(text, file);
    while (lines.next()) {
        const std::string_view line = trim(lines.line());
        if (is_blank_or_comment(line)) continue;
        return line.starts_with("VERTEX_") || line.starts_with("EDGE_") ||
               line.starts_with("PARAMS_") || line.starts_with("FIX ");
    }
    return false;
}

Pose vertex_pose(const std::vector<double>& row, const Lines& lines) {
    if (row.size() != 7) {
        lines.fail(fmt::format(
            "{} numbers behind the id; a VERTEX_SE3:QUAT is id x y z qx qy qz qw", row.size()));
    }
    if (!is_finite(row)) return lost_pose();
    return pose_from_quaternion({row[0], row[1], row[2]},
                                Eigen::Quaterniond(row[6], row[3], row[4], row[5]),
                                "id x y z qx qy qz qw (xyzw)", lines);
}

PoseFile read_g2o(Lines& lines) {
    std::map<std::uint64_t, Pose> vertices;
    while (lines.next()) {
        std::string_view rest = lines.line();
        if (next_token(rest) != "VERTEX_SE3:QUAT") continue;
        const std::string_view token = next_token(rest);
        const auto id = parse_count(token);
        if (!id) lines.fail(quote(token) + " is no id of a vertex; expected plain digits");
        if (!vertices.emplace(*id, vertex_pose(numbers(rest, lines), lines)).second) {
            lines.fail(fmt::format("two vertices have the id {}", *id));
        }
    }
    PoseFile file;
    for (const auto& [id, pose] : vertices) file.poses.push_back(pose);
    return file;
}

void refuse_other_kind(std::string_view text, const std::filesystem::path& file) {
    const std::string kind = kind_by_content(text.substr(0, 1000));
    if (kind.empty()) return;
    throw InputError(file, "",
                     "is " + kind + "; expected a pose file (KITTI, TUM, EuRoC, g2o or CSV)" +
                         (kind.ends_with("bag") ? "; poses of a bag come with its scans: give the "
                                                  "bag in place of the recording"
                                                : ""));
}

/// Throws if the first row has decimal commas, as some spreadsheets write them.
void refuse_decimal_commas(std::string_view text, const std::filesystem::path& file) {
    Lines lines(text, file);
    while (lines.next() && is_blank_or_comment(trim(lines.line()))) {
    }
    const auto within = [](std::string_view token) {
        const std::size_t comma = token.find(',');
        return comma != token.npos && comma + 1 < token.size();
    };
    const auto tokens = split_tokens(lines.line());
    if (lines.line().find(';') != std::string_view::npos) {
        lines.fail(
            "has semicolons; expected columns parted by commas or blanks, and decimal points");
    }
    if (tokens.size() >= tum_columns && std::all_of(tokens.begin(), tokens.end() - 1, within)) {
        lines.fail("has decimal commas; expected decimal points, as in 1.5");
    }
}

PoseFile read_any(const std::string& text, const std::filesystem::path& file) {
    Lines lines(text, file);
    if (is_g2o(text, file)) return read_g2o(lines);
    return is_csv(text, file) ? read_pose_table(lines) : read_rows(lines);
}

}  // namespace

void append_stamp(PoseFile& file, double stamp, const Lines& where) {
    if (!std::isfinite(stamp)) where.fail("the stamp is not finite");
    if (!file.stamps.empty() && stamp < file.stamps.back()) {
        where.fail(fmt::format("the stamp {} is before {} of the row above; sort the file by time",
                               stamp, file.stamps.back()));
    }
    file.stamps.push_back(stamp);
}

PoseFile read_poses(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    refuse_other_kind(text, file);
    refuse_decimal_commas(text, file);
    PoseFile poses = read_any(text, file);
    if (poses.poses.empty()) throw InputError(file, "", "holds no pose");
    return poses;
}

Pose read_calib_tr(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    Lines lines(text, file);
    while (lines.next()) {
        std::string_view rest = lines.line();
        if (next_token(rest) != "Tr:") continue;
        const std::vector<double> row = numbers(rest, lines);
        if (row.size() != kitti_columns || !is_finite(row)) {
            lines.fail("Tr: needs 12 finite numbers, a 3x4 matrix row by row");
        }
        return kitti_pose(row, 0, lines);
    }
    throw InputError(file, "",
                     "has no line 'Tr:' (velodyne to camera); add it, or remove the file "
                     "if the poses are those of the LiDAR");
}

std::vector<double> read_times(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    Lines lines(text, file);
    std::vector<double> stamps;
    while (lines.next()) {
        const std::string_view line = trim(lines.line());
        if (is_blank_or_comment(line)) continue;
        const auto stamp = parse_real(line);
        if (!stamp || !std::isfinite(*stamp)) {
            lines.fail(quote(line) + " is no time; expected one number a line, in seconds");
        }
        stamps.push_back(*stamp);
    }
    return stamps;
}

}  // namespace dynamic_filter::io
