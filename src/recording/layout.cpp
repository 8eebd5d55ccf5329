// SPDX-License-Identifier: MIT
#include "recording/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/input.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/clouds/registry.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/beside.hpp"
#include "recording/layouts/registry.hpp"
#include "recording/truth.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

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
void refuse_inner_folder(const fs::path& data) {
    const std::string name = without_slash(data).filename().string();
    if ((name != "velodyne" && name != "pcd") || find_pose_file(data)) return;
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
        const std::string force =
            kind.ends_with("bag")       ? "; leave --format out, or give --format bag"
            : kind.ends_with("cloud")   ? "; a single cloud cannot be cleaned, because "
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

/// Names a scan that seems to have lost its labels.
std::string first_without(const Layout& layout, const Paths& labels, std::size_t used) {
    const auto empty = std::find(labels.begin(), labels.end(), fs::path());
    if (used == 0 || empty == labels.end() || is_sparse_truth(used, labels.size())) return "";
    const auto scan = layout.scans.begin() + (empty - labels.begin());
    return ", the first is " + scan->filename().string();
}

Layout find_at(const Place& place);

/// The only scans below the folder, if there are none in the usual places.
std::optional<Layout> find_elsewhere(const Place& place) {
    const fs::path& data = place.data;
    if (has_scans(data)) return std::nullopt;
    refuse_argoverse(data);
    refuse_several_recordings(data);
    if (auto layout = find_parts(place)) return layout;
    auto folder = find_below(data, scan_extensions());
    if (!folder) return std::nullopt;
    const auto& usual = usual_scan_folders();
    const fs::path above = folder->parent_path();
    const bool is_usual =
        std::find(usual.begin(), usual.end(), folder->filename().string()) != usual.end();
    if (is_usual && whole_path(above) != whole_path(data)) folder = above;
    Layout layout = find_at({.data = *folder, .top = data, .options = place.options});
    layout.notes.insert(layout.notes.begin(), "no scans in " + data.string() + " itself, but in " +
                                                  layout.scan_folder.string());
    return layout;
}

Layout find_at(const Place& place) {
    refuse_inner_folder(place.data);
    if (auto layout = find_in_turn(Turn::contents, place)) return *std::move(layout);
    if (auto layout = find_elsewhere(place)) return *std::move(layout);
    return find_in_turn(Turn::usual, place).value();  // `folder` throws if it finds no scans
}

Layout find_named(const Place& place) {
    const LayoutRow& row = layout_row(place.options.layout);
    if (row.turn != Turn::path) require_folder(place.data);
    if (auto layout = ask(row, place)) return *std::move(layout);
    require_folder(place.data);
    throw not_of_layout(place.data, row);
}

}  // namespace

bool has_scans(const fs::path& data) {
    const auto& folders = usual_scan_folders();
    std::error_code ignored;
    return std::any_of(folders.begin(), folders.end(), [&](const std::string& name) {
        const fs::path folder = data / name;
        return is_folder(folder) && !list_files(folder, scan_extensions(), ignored).empty();
    });
}

Layout find_layout(const fs::path& data, const OpenOptions& options) {
    const Place place{.data = data, .top = data, .options = options};
    if (place.is_named()) return find_named(place);
    if (auto layout = find_in_turn(Turn::path, place)) return *std::move(layout);
    require_folder(data);
    return find_at(place);
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
            "{} holds labels of {} of {} scans, and {} of no scan; scans without are not scored{}",
            layout.labels->string(), used, labels.size(), files.size(),
            first_without(layout, labels, used)));
    }
    return used == 0 ? Paths{} : labels;
}

}  // namespace dynamic_filter::io
