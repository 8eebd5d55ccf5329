// SPDX-License-Identifier: MIT
#include <algorithm>

#include "dynamic_filter/error.hpp"
#include "formats/clouds/registry.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/beside.hpp"
#include "recording/layouts/pose_notes.hpp"

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

/// Finds the scans of one kind, in the usual subfolder or in the folder itself (which may also
/// contain maps).
void find_scans(Layout& layout, const fs::path& data) {
    for (const std::string& name : usual_scan_folders()) {
        layout.scan_folder = name == "." ? data : data / name;
        if (!is_folder(layout.scan_folder)) continue;
        layout.scans = list_files(layout.scan_folder, scan_extensions());
        if (!layout.scans.empty()) break;
    }
    if (layout.scans.empty()) {
        throw InputError(data, "",
                         "holds no scans; looked for velodyne/*.bin, pcd/*.pcd, and " +
                             patterns_of_scans() + " here and in Scans/, scans/, pcds/, clouds/");
    }
    const std::string kind = extension_of(layout.scans[0]);
    for (const fs::path& scan : layout.scans) {
        if (extension_of(scan) == kind) continue;
        throw InputError(layout.scan_folder, "",
                         "mixes " + layout.scans[0].filename().string() + " and " +
                             scan.filename().string() + "; keep scans of one kind in the folder");
    }
    refuse_other_floats(layout.scan_folder, layout.scans);
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

}  // namespace

std::optional<Layout> find_folder(const Place& place) {
    Layout layout;
    find_scans(layout, place.data);
    const Paths folders = companions(layout, place);
    find_poses(layout, folders, place.options);
    find_times_and_labels(layout, folders);
    return layout;
}

}  // namespace dynamic_filter::io
