// SPDX-License-Identifier: MIT
#include "recording/folders.hpp"
#include "recording/layouts/beside.hpp"
#include "recording/layouts/pose_notes.hpp"

namespace dynamic_filter::io {

std::optional<Layout> find_kitti(const Place& place) {
    const std::filesystem::path folder = place.data / "velodyne";
    if (!place.is_named() && !is_folder(folder)) return std::nullopt;
    Layout layout = scans_in(folder, ".bin", "kitti");
    layout.poses = place.options.poses;
    if (!layout.poses && !place.options.without_poses) {
        layout.poses = if_exists(place.data / "poses.txt");
        layout.notes.push_back(layout.poses ? "poses from " + layout.poses->string()
                                            : "no pose file found; looked for poses.txt in " +
                                                  place.data.string() +
                                                  offer_poses(layout.scans.size(), {place.data}));
    }
    find_times_and_labels(layout, {place.data});
    layout.calib = if_exists(place.data / "calib.txt");
    return layout;
}

}  // namespace dynamic_filter::io
