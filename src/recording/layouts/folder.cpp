// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <string>

#include "base/input.hpp"
#include "base/natural_order.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/clouds/registry.hpp"
#include "formats/clouds/text_cloud.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/beside.hpp"
#include "recording/layouts/pose_notes.hpp"
#include "recording/viewpoints.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

/// "*.bin, *.pcd" for the extensions of scans.
std::string patterns_of_scans() {
    std::string patterns;
    for (const std::string& kind : scan_extensions()) {
        patterns += (patterns.empty() ? "*" : ", *") + kind;
    }
    return patterns;
}

/// The .csv files with a header that names x, y and z; others hold poses or anything else.
Paths csv_scans(const fs::path& folder) {
    constexpr std::size_t header = 1U << 12U;
    std::error_code ignored;
    Paths scans;
    for (const fs::path& file : list_files(folder, {".csv"}, ignored)) {
        try {
            if (names_points(read_head(file, header))) scans.push_back(file);
        } catch (const InputError&) {
            continue;  // it cannot be read, so it is no scan
        }
    }
    return scans;
}

/// Throws with the command that unpacks them if there are compressed scans.
void refuse_compressed(const fs::path& folder) {
    std::error_code ignored;
    const Paths files = list_files(folder, {".laz"}, ignored);
    if (files.empty()) return;
    const fs::path las = fs::path(files[0].filename()).replace_extension(".las");
    throw InputError(folder, "",
                     "holds " + std::to_string(files.size()) +
                         " .laz files, which are compressed and "
                         "not read; unpack them to LAS, for instance each with `pdal translate " +
                         files[0].filename().string() + " " + las.string() +
                         "` or all with `laszip -i *.laz`");
}

/// The folders that may hold the scans, in the order in which they are looked for.
Paths folders_of_scans(const fs::path& data) {
    Paths folders;
    for (const std::string& name : usual_scan_folders()) {
        const fs::path folder = name == "." ? data : data / name;
        if (is_folder(folder)) folders.push_back(folder);
    }
    return folders;
}

void refuse_other_kinds(const Layout& layout) {
    const std::string kind = extension_of(layout.scans[0]);
    for (const fs::path& scan : layout.scans) {
        if (extension_of(scan) == kind) continue;
        throw InputError(layout.scan_folder, "",
                         "mixes " + layout.scans[0].filename().string() + " and " +
                             scan.filename().string() + "; keep scans of one kind in the folder");
    }
}

/// Finds the scans of one kind, in the usual subfolder or in the folder itself (which may also
/// contain maps).
void find_scans(Layout& layout, const fs::path& data) {
    const Paths folders = folders_of_scans(data);
    const auto find = [&](const auto& scans_in) {
        for (const fs::path& folder : folders) {
            if (!layout.scans.empty()) return;
            layout.scan_folder = folder;
            layout.scans = scans_in(folder);
        }
    };
    find([](const fs::path& folder) { return list_files(folder, scan_extensions()); });
    find(csv_scans);
    if (layout.scans.empty()) {
        for (const fs::path& folder : folders) refuse_compressed(folder);
        throw InputError(data, "",
                         "holds no scans; looked for velodyne/*.bin, pcd/*.pcd, and " +
                             patterns_of_scans() +
                             ", or *.csv with columns x, y, z, here and in Scans/, scans/, pcds/, "
                             "clouds/");
    }
    refuse_other_kinds(layout);
    choose_bin_points(layout);
}

/// Folders that may contain the files that belong to the scans: that of the scans, the one above,
/// and for scans found below the folder that was given, all up to it.
Paths companions(const Layout& layout, const Place& place) {
    Paths folders = {layout.scan_folder, parent_of(layout.scan_folder)};
    const fs::path last = whole_path(place.top);
    for (fs::path at = whole_path(folders.back());
         place.data != place.top && at != last && at != at.root_path(); at = at.parent_path()) {
        folders.push_back(parent_of(folders.back()));
    }
    return folders;
}

void find_poses(Layout& layout, const Paths& folders, const OpenOptions& options) {
    layout.poses = options.poses;
    if (layout.poses || options.without_poses) return;
    std::string looked, names;
    for (const fs::path& folder : folders) {
        layout.poses = find_pose_file(folder);
        if (layout.poses) return layout.notes.push_back("poses from " + layout.poses->string());
        looked += (looked.empty() ? "" : " and ") + folder.string();
    }
    for (const std::string& name : pose_names()) names += name + ", ";
    layout.notes.push_back("no pose file found; looked for " + names + "*.tum in " + looked +
                           offer_poses(layout.scans.size(), folders));
}

/// The folders in `data` that are named by numbers and hold scans but no poses of their own.
Paths numbered_folders(const fs::path& data) {
    Paths folders;
    std::error_code ignored;
    for (const fs::path& folder : list_folders(data)) {
        const std::string name = folder.filename().string();
        const bool is_number = name.find_first_not_of("0123456789") == std::string::npos;
        const bool holds = !list_files(folder, scan_extensions(), ignored).empty();
        if (is_number && holds && !find_pose_file(folder)) folders.push_back(folder);
    }
    sort_naturally(folders);
    return folders;
}

/// Labels are named like their scans, so two scans of one name cannot be in one recording.
void refuse_names_that_begin_anew(const fs::path& data, const Paths& scans) {
    std::map<std::string, fs::path> seen;
    for (const fs::path& scan : scans) {
        const auto [first, fresh] = seen.try_emplace(scan.stem().string(), scan);
        if (fresh) continue;
        throw InputError(data, "",
                         "the poses are those of the scans of several folders, but " +
                             first->second.lexically_relative(data).string() + " and " +
                             scan.lexically_relative(data).string() +
                             " have the same name; number the scans through, or give each folder "
                             "its own poses, and it alone");
    }
}

}  // namespace

std::optional<Layout> find_parts(const Place& place) {
    if (!place.options.poses && !find_pose_file(place.data)) return std::nullopt;
    const Paths folders = numbered_folders(place.data);
    if (folders.size() < 2) return std::nullopt;
    Layout layout;
    layout.name = "folder";
    layout.scan_folder = place.data;
    for (const fs::path& folder : folders) {
        const Paths scans = list_files(folder, scan_extensions());
        layout.scans.insert(layout.scans.end(), scans.begin(), scans.end());
    }
    refuse_names_that_begin_anew(place.data, layout.scans);
    refuse_other_kinds(layout);
    choose_bin_points(layout);
    layout.notes.push_back("the scans of " + std::to_string(folders.size()) + " folders, " +
                           folders.front().filename().string() + " to " +
                           folders.back().filename().string() + ", are read as one drive");
    find_poses(layout, {place.data}, place.options);
    find_times_and_labels(layout, {place.data});
    return layout;
}

std::optional<Layout> find_folder(const Place& place) {
    Layout layout;
    find_scans(layout, place.data);
    const Paths folders = companions(layout, place);
    find_poses(layout, folders, place.options);
    if (!layout.poses && !place.options.without_poses) use_viewpoints(layout);
    find_times_and_labels(layout, folders);
    return layout;
}

}  // namespace dynamic_filter::io
