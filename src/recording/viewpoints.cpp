// SPDX-License-Identifier: MIT
#include "recording/viewpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/input.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/clouds/pcd_header.hpp"
#include "recording/scan_overlay.hpp"

namespace dynamic_filter::io {
namespace {

/// Of some scans, because most folders have the same VIEWPOINT in all.
bool viewpoint_moves(const Paths& scans) {
    constexpr std::size_t kSome = 50;
    const Pose first = viewpoint_of(scans.front()).value_or(Pose::Identity());
    const std::size_t step = scans.size() / kSome + 1;
    for (std::size_t i = step; i < scans.size(); i += step) {
        const Pose other = viewpoint_of(scans[i]).value_or(Pose::Identity());
        if (!other.isApprox(first, 1e-6)) return true;
    }
    return false;
}

}  // namespace

std::optional<Pose> viewpoint_of(const std::filesystem::path& scan) {
    constexpr std::size_t kHead = 4096;  // a header has only a few hundred bytes
    if (scan.extension() != ".pcd") return std::nullopt;
    try {
        const std::string head = read_head(scan, kHead);
        Lines lines(head, scan);
        return parse_pcd_header(lines).viewpoint;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

void use_viewpoints(Layout& layout) {
    if (layout.scans.front().extension() != ".pcd" || !viewpoint_moves(layout.scans)) return;
    for (const std::filesystem::path& scan : layout.scans) {
        layout.T_world_sensor.push_back(viewpoint_of(scan).value_or(Pose::Identity()));
    }
    layout.poses_in_scans = true;
    const ScanOverlay overlay(layout.scans.size(),
                              [&](std::size_t i) { return layout.read(layout.scans[i]); });
    const auto pose = [&](std::size_t i) { return layout.T_world_sensor[i]; };
    const double in_sensor = overlay.share(pose), in_world = overlay.share(pose, true);
    // The files of DynamicMap_Benchmark, which began to use the VIEWPOINT so, have them in the
    // world.
    layout.points_in_world = !overlays_better(in_sensor, in_world);
    const auto percent = [](double share) { return fmt::format("{:.0f} %", 100.0 * share); };
    layout.notes.push_back(
        "VIEWPOINT differs from scan to scan, so it gives the poses; the points are taken to be "
        "in " +
        (layout.points_in_world
             ? "the world's frame: scans overlay by " + percent(in_world) + " then, and by " +
                   percent(in_sensor) + " if they are in the sensor's"
             : "the sensor's frame: scans overlay by " + percent(in_sensor) + " then, and by " +
                   percent(in_world) + " if they are in the world's"));
}

}  // namespace dynamic_filter::io
