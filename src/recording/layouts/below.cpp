// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "dynamic_filter/error.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/drive.hpp"
#include "recording/layouts/layouts.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

constexpr int deepest = 4;  // DATA/dataset/sequences/08/velodyne

struct Found {
    fs::path folder;
    std::size_t scans = 0;
};

/// True for the output folder of a run, whose clouds are no scans.
bool is_passed_over(const fs::path& folder) {
    return folder.filename().string().starts_with('.') ||
           (present(folder / "run.log") && present(folder / "config.toml"));
}

/// The scans of a recording in its own folder, which is the one to open; empty for other folders.
std::optional<fs::path> scans_of_recording(const fs::path& folder,
                                           const std::set<std::string>& kinds) {
    if (is_drive(folder)) return folder / "velodyne_points" / "data";
    for (const char* name : {"velodyne", "pcd"}) {
        std::error_code ignored;
        if (!list_files(folder / name, kinds, ignored).empty()) return folder / name;
    }
    return std::nullopt;
}

void search(const fs::path& data, const std::set<std::string>& kinds, int depth,
            std::vector<Found>& found) {
    for (const fs::path& folder : list_folders(data)) {
        if (is_passed_over(folder)) continue;
        std::error_code ignored;
        if (const auto scans = scans_of_recording(folder, kinds)) {
            found.push_back({folder, list_files(*scans, kinds, ignored).size()});
            continue;
        }
        const std::size_t scans = list_files(folder, kinds, ignored).size();
        if (scans > 0) found.push_back({folder, scans});
        if (depth < deepest) search(folder, kinds, depth + 1, found);
    }
}

}  // namespace

std::optional<fs::path> find_below(const fs::path& data, const std::set<std::string>& kinds) {
    std::vector<Found> found;
    search(data, kinds, 1, found);
    if (found.empty()) return std::nullopt;
    if (found.size() == 1) return found.front().folder;
    std::string names;
    constexpr std::size_t shown = 10;
    for (std::size_t i = 0; i < std::min(found.size(), shown); ++i) {
        names += fmt::format("{}{} ({} files)", i == 0 ? "" : ", ",
                             found[i].folder.lexically_relative(data).string(), found[i].scans);
    }
    if (found.size() > shown) names += fmt::format(" and {} more", found.size() - shown);
    throw InputError(data, "",
                     "holds no scans itself, but several folders below do: " + names +
                         "; give one of them, such as " + found.front().folder.string() +
                         ", or put the scans of one drive into one folder");
}

}  // namespace dynamic_filter::io
