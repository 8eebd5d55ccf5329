// SPDX-License-Identifier: MIT
#include "dynamic_filter/poses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>

#include "base/input.hpp"
#include "base/text.hpp"
#include "base/utf16.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/poses/pose_rows.hpp"
#include "formats/poses/pose_table.hpp"
#include "formats/poses/rigid.hpp"

namespace dynamic_filter::io {
namespace {

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
    if (!are_finite(row)) return lost_pose();
    return pose_from_quaternion({row[0], row[1], row[2]},
                                Eigen::Quaterniond(row[6], row[3], row[4], row[5]),
                                "id x y z qx qy qz qw (xyzw)", lines);
}

PoseRows read_g2o(Lines& lines) {
    std::map<std::uint64_t, Pose> vertices;
    while (lines.next()) {
        std::string_view rest = lines.line();
        if (next_token(rest) != "VERTEX_SE3:QUAT") continue;
        const std::string_view token = next_token(rest);
        const auto id = parse_count(token);
        if (!id) lines.fail(quote(token) + " is no id of a vertex; expected plain digits");
        if (!vertices.emplace(*id, vertex_pose(numbers_of(rest, lines), lines)).second) {
            lines.fail(fmt::format("two vertices have the id {}", *id));
        }
    }
    PoseRows rows;
    for (const auto& [id, pose] : vertices) rows.file.poses.push_back(pose);
    return rows;
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
    constexpr std::size_t fewest = 8;  // those of TUM
    const auto tokens = split_tokens(lines.line());
    if (lines.line().find(';') != std::string_view::npos) {
        lines.fail(
            "has semicolons; expected columns parted by commas or blanks, and decimal points");
    }
    if (tokens.size() >= fewest && std::all_of(tokens.begin(), tokens.end() - 1, within)) {
        lines.fail("has decimal commas; expected decimal points, as in 1.5");
    }
}

PoseRows read_any(const std::string& text, const std::filesystem::path& file) {
    Lines lines(text, file);
    if (is_g2o(text, file)) return read_g2o(lines);
    const Titles titles = find_titles(text, file);
    const bool is_table = titles.line != 0 && titles.are_read;
    return is_table ? read_pose_table(lines, titles.line) : read_pose_rows(lines, titles.line);
}

/// The numbers behind the first of these keys that a line has.
std::optional<std::vector<double>> numbers_behind(std::initializer_list<const char*> keys,
                                                  const std::string& text,
                                                  const std::filesystem::path& file) {
    for (const char* const key : keys) {
        Lines lines(text, file);
        while (lines.next()) {
            std::string_view rest = lines.line();
            if (next_token(rest) == key) return numbers_of(rest, lines);
        }
    }
    return std::nullopt;
}

/// Pose of the velodyne in the frame of the camera, of the 12 numbers of a calibration.
Pose pose_of_camera(const std::vector<double>& row, const char* key,
                    const std::filesystem::path& file) {
    if (row.size() != 12 || !are_finite(row)) {
        throw InputError(file, key, "needs 12 finite numbers, a 3x4 matrix row by row");
    }
    const Lines where("", file);
    return pose_from_rows(Eigen::Map<const Rows34>(row.data()), where);
}

/// The rotation that aligns the axes of the cameras; none in files that do not name it.
Pose rectification(const std::string& text, const std::filesystem::path& file) {
    constexpr const char* key = "R0_rect";
    const auto nine = numbers_behind({"R0_rect:", "R0_rect", "R_rect:", "R_rect"}, text, file);
    if (!nine) return Pose::Identity();
    if (nine->size() != 9) throw InputError(file, key, "needs 9 numbers, a rotation row by row");
    std::vector<double> rows;
    for (std::size_t i = 0; i < 9; ++i) {
        rows.push_back((*nine)[i]);
        if (i % 3 == 2) rows.push_back(0.0);
    }
    return pose_of_camera(rows, key, file);
}

}  // namespace

PoseFile read_poses(const std::filesystem::path& file) {
    const std::string text = decoded(read_file(file));
    refuse_other_kind(text, file);
    refuse_decimal_commas(text, file);
    PoseRows rows = read_any(text, file);
    if (rows.file.poses.empty()) throw InputError(file, "", "holds no pose");
    return in_order(std::move(rows), file);
}

Pose read_calib_tr(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    if (const auto row = numbers_behind({"Tr:"}, text, file)) {
        return pose_of_camera(*row, "Tr:", file);
    }
    const auto row = numbers_behind({"Tr_velo_to_cam:", "Tr_velo_cam:", "Tr_velo_cam"}, text, file);
    if (row) return rectification(text, file) * pose_of_camera(*row, "Tr_velo_to_cam:", file);
    throw InputError(file, "",
                     "has no line 'Tr:', 'Tr_velo_to_cam:' or 'Tr_velo_cam:' (velodyne to camera); "
                     "add it, or remove the file if the poses are those of the LiDAR");
}

std::vector<double> read_times(const std::filesystem::path& file) {
    const std::string text = decoded(read_file(file));
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
