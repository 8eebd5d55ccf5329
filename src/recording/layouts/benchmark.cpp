// SPDX-License-Identifier: MIT
#include "recording/benchmark.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/beside.hpp"

namespace dynamic_filter::io {

std::optional<Layout> find_benchmark(const Place& place) {
    const std::filesystem::path folder = place.data / "pcd";
    if (!place.is_named()) {
        const Paths scans = is_folder(folder) ? list_files(folder, {".pcd"}) : Paths{};
        const bool is_single = scans.size() == 1 || present(place.data / "gt_cloud.pcd");
        if (scans.empty() || (!is_single && !any_has_viewpoint(scans))) return std::nullopt;
    }
    Layout layout = scans_in(folder, ".pcd", "benchmark");
    layout.poses = place.options.poses;
    layout.poses_in_scans = !layout.poses;
    layout.points_in_world = true;
    layout.truth_in_intensity = true;
    find_times_and_labels(layout, {place.data});
    layout.truth_map = if_exists(place.data / "gt_cloud.pcd");
    return layout;
}

}  // namespace dynamic_filter::io
