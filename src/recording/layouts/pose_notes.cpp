// SPDX-License-Identifier: MIT
#include "recording/layouts/pose_notes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "recording/folders.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

/// True for a row of a pose file: it has at least seven columns and begins with a number, unlike
/// headers and comments.
bool is_row(std::string_view line) {
    const bool commas = line.find(',') != std::string_view::npos;
    const auto cells = commas ? split_at(line, ',') : split_tokens(line);
    return cells.size() >= 7 && parse_real(cells.front()).has_value();
}

/// Number of rows that look like poses; 0 for a file that is far too long for this number of scans.
std::size_t count_rows(const fs::path& file, std::size_t scans) {
    constexpr std::size_t longest_row = 1000;  // [bytes]
    std::error_code error;
    const auto size = fs::file_size(file, error);
    if (error || size > longest_row * (scans + 10)) return 0;
    const std::string text = read_file(file);
    Lines lines(text, file);
    std::size_t rows = 0;
    while (lines.next()) rows += is_row(lines.line()) ? 1 : 0;
    return rows;
}

bool looks_like_poses(const fs::path& file, std::size_t scans) {
    const auto& names = pose_names();
    if (std::find(names.begin(), names.end(), file.filename().string()) != names.end()) return true;
    try {
        return count_rows(file, scans) == scans;
    } catch (const InputError&) {
        return false;
    }
}

}  // namespace

const std::vector<std::string>& pose_names() {
    static const std::vector<std::string> names = {"poses.txt", "optimized_poses.txt",
                                                   "poses.csv", "poses_lidar2body.csv",
                                                   "traj.txt",  "trajectory.txt"};
    return names;
}

void note_lost(Layout& layout) {
    const auto lost = std::count_if(layout.T_world_sensor.begin(), layout.T_world_sensor.end(),
                                    [](const Pose& pose) { return !pose.matrix().allFinite(); });
    if (lost == 0) return;
    layout.notes.push_back(
        fmt::format("{} of {} scans have no pose", lost, layout.T_world_sensor.size()));
}

std::string offer_poses(std::size_t scans, const Paths& folders) {
    constexpr std::size_t most = 100;  // if each scan has a text file, these are no pose files
    std::string offer;
    for (const fs::path& folder : folders) {
        std::error_code ignored;
        const Paths files = list_files(folder, {".txt", ".csv", ".tum"}, ignored);
        if (files.size() > most) continue;
        for (const fs::path& file : files) {
            if (!looks_like_poses(file, scans)) continue;
            offer += (offer.empty() ? "; try --poses " : " or --poses ") + file.string();
        }
    }
    return offer;
}

}  // namespace dynamic_filter::io
