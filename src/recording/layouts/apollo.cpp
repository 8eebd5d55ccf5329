// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "base/input.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/layouts.hpp"
#include "recording/layouts/numbers.hpp"
#include "recording/layouts/pose_notes.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kColumns = 9;

struct Row {
    double stamp = 0.0;
    Pose pose = Pose::Identity();
};
using Rows = std::map<std::size_t, Row>;

/// Decides by the first row: it has nine columns, and the first one is a whole number.
bool has_nine_columns(const fs::path& file) {
    const std::string head = read_head(file, 4096);
    Lines lines(head, file);
    while (lines.next()) {
        if (is_blank_or_comment(trim(lines.line()))) continue;
        const auto tokens = split_tokens(lines.line());
        return tokens.size() == kColumns && parse_count(tokens[0]);
    }
    return false;
}

Rows read_rows(const fs::path& file) {
    const std::string text = read_file(file);
    Lines lines(text, file);
    Rows rows;
    while (lines.next()) {
        std::string_view rest = lines.line();
        if (is_blank_or_comment(trim(rest))) continue;
        const std::string_view token = next_token(rest);
        const auto index = parse_count(token);
        if (!index) lines.fail(quote(token) + " is no number of a scan");
        const std::vector<double> v = read_numbers(rest, lines);
        if (v.size() != kColumns - 1) {
            lines.fail(fmt::format("{} columns; expected {}: index stamp x y z qx qy qz qw",
                                   v.size() + 1, kColumns));
        }
        if (!std::isfinite(v[0])) lines.fail("the stamp is not finite");
        const Pose pose =
            pose_from_quaternion({v[1], v[2], v[3]}, Eigen::Quaterniond(v[7], v[4], v[5], v[6]),
                                 "index stamp x y z qx qy qz qw (xyzw)", lines);
        const auto [other, fresh] = rows.emplace(*index, Row{v[0], pose});
        if (!fresh) lines.fail(fmt::format("two rows are of scan {}", *index));
    }
    return rows;
}

std::optional<fs::path> apollo_scan_folder(const fs::path& data) {
    std::error_code ignored;
    for (const char* name : {"pcds", "pcd"}) {
        if (!list_files(data / name, {".pcd"}, ignored).empty()) return data / name;
    }
    return std::nullopt;
}

std::optional<fs::path> pose_file_of(const fs::path& data, const OpenOptions& options) {
    const Paths usual = {data / "poses.txt", data / "poses" / "gt_poses.txt"};
    for (const fs::path& file : options.poses ? Paths{*options.poses} : usual) {
        if (present(file) && !is_folder(file) && has_nine_columns(file)) return file;
    }
    return std::nullopt;
}

/// Adds the stamps of all scans, or of none: without its row, the time of a scan is not known.
void add_stamps(Layout& layout, const Rows& rows) {
    for (const fs::path& scan : layout.scans) {
        const auto index = index_of(scan);
        const auto row = index ? rows.find(*index) : rows.end();
        if (row == rows.end()) {
            layout.notes.push_back("no stamps are taken from the poses: " +
                                   scan.filename().string() + " has no row there");
            return layout.stamps.clear();
        }
        layout.stamps.push_back(row->second.stamp);
    }
}

}  // namespace

std::optional<Layout> find_apollo(const Place& place) {
    const auto folder = apollo_scan_folder(place.data);
    const auto file = folder ? pose_file_of(place.data, place.options) : std::nullopt;
    if (!file) return std::nullopt;
    Layout layout;
    layout.scan_folder = *folder;
    layout.scans = list_files(*folder, {".pcd"});
    const Rows rows = read_rows(*file);
    add_stamps(layout, rows);
    if (place.options.without_poses) return layout;
    std::size_t found = 0;
    for (const fs::path& scan : layout.scans) {
        const auto index = index_of(scan);
        const auto row = index ? rows.find(*index) : rows.end();
        layout.T_world_sensor.push_back(row == rows.end() ? lost_pose() : row->second.pose);
        found += row == rows.end() ? 0 : 1;
    }
    if (found == 0) {
        throw InputError(*file, "",
                         "has no row of any scan in " + folder->string() +
                             ", which are matched by their numbers");
    }
    layout.pose_source = *file;
    layout.notes.push_back("poses from " + file->string() + ", by the scans' numbers");
    note_lost(layout);
    return layout;
}

}  // namespace dynamic_filter::io
