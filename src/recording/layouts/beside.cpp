// SPDX-License-Identifier: MIT
#include "recording/layouts/beside.hpp"

#include <fmt/format.h>

#include "dynamic_filter/error.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/pose_notes.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> find_beside(const Paths& folders, const char* name) {
    for (const fs::path& folder : folders) {
        if (present(folder / name)) return folder / name;
    }
    return std::nullopt;
}

}  // namespace

bool prefers_other_poses(const Place& place) { return place.options.poses && !place.is_named(); }

bool has_given_poses(Layout& layout, const Place& place) {
    layout.poses = place.options.poses;
    return layout.poses.has_value();
}

std::optional<fs::path> if_exists(const fs::path& path) {
    return present(path) ? std::optional(path) : std::nullopt;
}

Layout scans_in(const fs::path& folder, const char* extension, const char* layout) {
    Layout found;
    found.scan_folder = folder;
    if (is_folder(folder)) found.scans = list_files(folder, {extension});
    if (found.scans.empty()) {
        throw InputError(folder, "",
                         fmt::format("no *{} found; a recording of format {} keeps its scans there",
                                     extension, layout));
    }
    choose_bin_points(found);
    return found;
}

std::optional<fs::path> find_pose_file(const fs::path& folder) {
    for (const std::string& name : pose_names()) {
        if (present(folder / name)) return folder / name;
    }
    std::error_code ignored;  // the parent folder may be unreadable, which is no error
    const Paths tum = list_files(folder, {".tum"}, ignored);
    if (tum.size() > 1) {
        throw InputError(folder, "",
                         fmt::format("has {} .tum files; choose one with --poses", tum.size()));
    }
    return tum.empty() ? std::nullopt : std::optional(tum[0]);
}

void find_times_and_labels(Layout& layout, const Paths& folders) {
    layout.times = find_beside(folders, "times.txt");
    layout.labels = find_beside(folders, "labels");
}

}  // namespace dynamic_filter::io
