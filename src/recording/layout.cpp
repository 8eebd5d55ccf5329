// SPDX-License-Identifier: MIT
#include "recording/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/input.hpp"
#include "dynamic_filter/error.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/layouts.hpp"
#include "recording/layouts/pose_notes.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

fs::path without_slash(const fs::path& path) {
    const fs::path normal = path.lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
}

fs::path parent_of(const fs::path& folder) {
    std::error_code ignored;
    const fs::path parent = without_slash(folder).parent_path();
    if (!parent.empty() && folder.filename() != "." && folder.filename() != "..") return parent;
    return without_slash(fs::absolute(folder, ignored)).parent_path();
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

std::optional<fs::path> if_exists(const fs::path& path) {
    return present(path) ? std::optional(path) : std::nullopt;
}

/// True if the PCD files of the folder bear poses, as those of DynamicMap_Benchmark do.
bool has_viewpoints(const fs::path& folder) {
    std::error_code ignored;
    const Paths clouds = list_files(folder, {".pcd"}, ignored);
    if (clouds.empty()) return false;
    const std::string head = read_head(clouds.front(), 1000), key = "\nVIEWPOINT ";
    const std::size_t at = head.find(key);
    return at != std::string::npos && !head.substr(at + key.size()).starts_with("0 0 0 1 0 0 0");
}

/// Throws if the user gave DATA/velodyne in place of DATA, a common mistake: poses, labels and
/// calibration would not be found.
void refuse_inner_folder(const fs::path& data, const OpenOptions& options) {
    const std::string name = without_slash(data).filename().string();
    if (options.format || (name != "velodyne" && name != "pcd") || find_pose_file(data)) return;
    const fs::path above = parent_of(data);
    const bool is_recording = find_pose_file(above) || present(above / "labels") ||
                              present(above / "calib.txt") || present(above / "gt_cloud.pcd") ||
                              has_viewpoints(data);
    if (!is_recording) return;
    throw InputError(data, "",
                     "is the scan folder inside a recording; give the folder above it (" +
                         above.string() + "), or force --format folder");
}

void require_folder(const fs::path& data) {
    if (!present(data))
        throw InputError(
            data, "", "does not exist; expected a bag (.mcap, .bag, .db3) or a folder with scans");
    if (!is_folder(data)) {
        const std::string kind = kind_by_content(read_head(data, 100));
        const std::string force = kind.ends_with("bag") ? "; force --format bag"
                                  : kind.ends_with("cloud")
                                      ? "; a single cloud cannot be cleaned, because "
                                        "the scans tell what moved"
                                  : kind.ends_with("archive") ? "; unpack it and give the folder"
                                                              : "";
        throw InputError(data, "",
                         "is " + (kind.empty() ? "a file" : kind) + force +
                             "; expected a bag (.mcap, .bag, .db3), or a folder with "
                             "velodyne/*.bin, pcd/*.pcd, or scans and a pose file");
    }
    if (present(data / "part.json") && present(data / "config.toml")) {
        throw InputError(data, "",
                         "is a part of a run, not a recording; `dynamicfilter merge` puts the "
                         "parts together");
    }
    if (present(data / "run.log") && present(data / "config.toml")) {
        throw InputError(data, "",
                         "is the output of a run, not a recording; give the recording that run.log "
                         "there names (static_map.pcd is the clean map)");
    }
}

const std::vector<std::string>& scan_folders() {
    static const std::vector<std::string> names = {"Scans",  "scans",    "pcds", "pcd",
                                                   "clouds", "velodyne", "."};
    return names;
}

const std::set<std::string>& scan_kinds() {
    static const std::set<std::string> kinds = {".bin", ".pcd", ".ply", ".las", ".npy"};
    return kinds;
}

Format recognise(const fs::path& data) {
    if (is_folder(data / "velodyne")) return Format::kitti;
    if (is_folder(data / "pcd") && !list_files(data / "pcd", {".pcd"}).empty()) {
        return Format::benchmark;
    }
    return Format::folder;
}

/// Finds the scans of one kind, in the usual subfolder or in the folder itself (which may also
/// contain maps).
void find_folder_scans(Layout& layout, const fs::path& data) {
    for (const std::string& name : scan_folders()) {
        layout.scan_folder = name == "." ? data : data / name;
        if (!is_folder(layout.scan_folder)) continue;
        layout.scans = list_files(layout.scan_folder, scan_kinds());
        if (!layout.scans.empty()) break;
    }
    if (layout.scans.empty()) {
        throw InputError(data, "",
                         "holds no scans; looked for velodyne/*.bin, pcd/*.pcd, and *.bin, *.pcd, "
                         "*.ply, *.las, *.npy here and in Scans/, scans/, pcds/, clouds/");
    }
    const std::string kind = extension_of(layout.scans[0]);
    for (const fs::path& scan : layout.scans) {
        if (extension_of(scan) == kind) continue;
        throw InputError(layout.scan_folder, "",
                         "mixes " + layout.scans[0].filename().string() + " and " +
                             scan.filename().string() + "; keep scans of one kind in the folder");
    }
}

void find_scans(Layout& layout, const fs::path& data) {
    if (layout.format == Format::folder) {
        find_folder_scans(layout, data);
        return refuse_other_floats(layout.scan_folder, layout.scans);
    }
    const bool kitti = layout.format == Format::kitti;
    layout.scan_folder = data / (kitti ? "velodyne" : "pcd");
    const std::string kind = kitti ? ".bin" : ".pcd";
    if (is_folder(layout.scan_folder)) layout.scans = list_files(layout.scan_folder, {kind});
    if (layout.scans.empty()) {
        throw InputError(layout.scan_folder, "",
                         "no *" + kind + " found; a recording of format " +
                             to_string(layout.format) + " keeps its scans there");
    }
    refuse_other_floats(layout.scan_folder, layout.scans);
}

/// Folders that may contain the files that belong to the scans: for scans found below `top`, all
/// folders up to it.
Paths companions(const Layout& layout, const fs::path& data, const fs::path& top) {
    if (layout.format != Format::folder) return {data};
    Paths folders = {layout.scan_folder, parent_of(layout.scan_folder)};
    const fs::path last = whole_path(top);
    for (fs::path at = whole_path(folders.back());
         data != top && at != last && at != at.root_path(); at = at.parent_path()) {
        folders.push_back(parent_of(folders.back()));
    }
    return folders;
}

std::optional<fs::path> find_beside(const Paths& folders, const char* name) {
    for (const fs::path& folder : folders) {
        if (present(folder / name)) return folder / name;
    }
    return std::nullopt;
}

void find_poses(Layout& layout, const Paths& folders, const OpenOptions& options) {
    layout.poses = options.poses;
    if (layout.poses || options.without_poses || layout.format == Format::benchmark) return;
    std::string looked;
    for (const fs::path& folder : folders) {
        layout.poses = layout.format == Format::kitti ? if_exists(folder / "poses.txt")
                                                      : find_pose_file(folder);
        if (layout.poses) return layout.notes.push_back("poses from " + layout.poses->string());
        looked += (looked.empty() ? "" : " and ") + folder.string();
    }
    std::string names = pose_names()[0];
    for (std::size_t i = 1; layout.format == Format::folder && i < pose_names().size(); ++i) {
        names += ", " + pose_names()[i];
    }
    if (layout.format == Format::folder) names += ", *.tum";
    layout.notes.push_back("no pose file found; looked for " + names + " in " + looked +
                           offer_poses(layout.scans.size(), folders));
}

using Finder = std::optional<Layout> (*)(const fs::path& data, const OpenOptions& options);

/// Layouts that contain poses; most of them are not used if other poses are given.
std::optional<Layout> find_by_contents(const fs::path& data, const OpenOptions& options) {
    for (const Finder find : {find_kitti_360, find_kitti_raw, find_apollo, find_mulran}) {
        if (auto layout = find(data, options)) return layout;
    }
    if (options.poses) return std::nullopt;
    for (const auto find : {find_pairs, find_glim}) {
        if (auto layout = find(data)) return layout;
    }
    return std::nullopt;
}

Layout find_at(const fs::path& data, const fs::path& top, const OpenOptions& options);

/// The only scans below `data`, if there are none in the usual places.
std::optional<Layout> find_elsewhere(const fs::path& data, const OpenOptions& options) {
    if (has_scans(data)) return std::nullopt;
    refuse_argoverse(data);
    refuse_several_recordings(data);
    auto folder = find_below(data, scan_kinds());
    if (!folder) return std::nullopt;
    const auto& usual = scan_folders();
    const fs::path above = folder->parent_path();
    const bool is_usual =
        std::find(usual.begin(), usual.end(), folder->filename().string()) != usual.end();
    if (is_usual && whole_path(above) != whole_path(data)) folder = above;
    Layout layout = find_at(*folder, data, options);
    layout.notes.insert(layout.notes.begin(), "no scans in " + data.string() + " itself, but in " +
                                                  layout.scan_folder.string());
    return layout;
}

Layout find_at(const fs::path& data, const fs::path& top, const OpenOptions& options) {
    refuse_inner_folder(data, options);
    if (!options.format) {
        if (auto layout = find_by_contents(data, options)) return *std::move(layout);
        if (auto layout = find_elsewhere(data, options)) return *std::move(layout);
    }
    Layout layout;
    layout.format = options.format.value_or(recognise(data));
    find_scans(layout, data);
    const Paths folders = companions(layout, data, top);
    find_poses(layout, folders, options);
    layout.times = find_beside(folders, "times.txt");
    layout.labels = find_beside(folders, "labels");
    if (layout.format == Format::kitti) layout.calib = if_exists(data / "calib.txt");
    if (layout.format == Format::benchmark) layout.truth_map = if_exists(data / "gt_cloud.pcd");
    return layout;
}

}  // namespace

bool has_scans(const fs::path& data) {
    std::error_code ignored;
    return std::any_of(scan_folders().begin(), scan_folders().end(), [&](const std::string& name) {
        const fs::path folder = data / name;
        return is_folder(folder) && !list_files(folder, scan_kinds(), ignored).empty();
    });
}

Layout find_layout(const fs::path& data, const OpenOptions& options) {
    if (!options.format && !options.poses) {
        if (auto layout = find_nuscenes(without_slash(data))) return *std::move(layout);
    }
    require_folder(data);
    return find_at(data, data, options);
}

Paths find_labels(const Layout& layout, std::vector<std::string>& notes) {
    if (!layout.labels) return {};
    std::map<std::string, fs::path> files;
    for (const fs::path& path : list_files(*layout.labels, {".label"})) {
        files[path.stem().string()] = path;
    }
    const std::size_t found = files.size();
    Paths labels;
    for (const fs::path& scan : layout.scans) {
        auto file = files.extract(scan.stem().string());
        labels.push_back(file.empty() ? fs::path() : file.mapped());
    }
    const std::size_t used = found - files.size();
    if (used < labels.size() || !files.empty()) {
        notes.push_back(fmt::format(
            "{} holds labels of {} of {} scans, and {} of no scan; scans without are not scored",
            layout.labels->string(), used, labels.size(), files.size()));
    }
    return used == 0 ? Paths{} : labels;
}

}  // namespace dynamic_filter::io
