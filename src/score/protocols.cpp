// SPDX-License-Identifier: MIT
#include "score/protocols.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "score/report.hpp"

namespace dynamic_filter::app {

namespace {

struct Protocol {
    const char* name;
    const char* reading;  ///< of mixed voxels; empty: scored by points
    const char* rule;     ///< {0}: voxel size [m]; {1}: half a voxel's diagonal [m]
};

constexpr std::array kProtocols{
    Protocol{
        "voxel", "excluded",
        "voxels of {0:g} m; a voxel is preserved if a point of the clean map lies in it; voxels "
        "with static and dynamic points are left out"},
    Protocol{
        "erasor", "erasor",
        "maps with one point in each voxel of {0:g} m, scan by scan and then of all scans; the "
        "point "
        "has the label of the nearest one that was measured, and is preserved if the nearest point "
        "of the clean map is within {1:.3f} m and has the same label; points without ground truth "
        "are static, and those nearer than 2.7 m to the sensor's axis are left out"},
    Protocol{
        "strict", "static_wins",
        "voxels of {0:g} m; a voxel is preserved if a point of the clean map lies in it; voxels "
        "with any static point are static"},
    Protocol{"benchmark", "", "points of the ground truth within 0.05 m of the clean map"},
    Protocol{"mos", "", "points of all scans together; points without ground truth are left out"},
};

std::string rates(const eval::VoxelScore& s) {
    return fmt::format("PR {} %  RR {} %  F1 {}", percent(s.pr), percent(s.rr), three_digits(s.f1));
}

/// Rates of the project's own protocol say by the shifted grid how much is chance of the grid.
std::string on_shifted_grid(const Protocol& p, const eval::Scores& scores) {
    const auto found = scores.voxel_shifted.find(p.reading);
    if (p.name != std::string("voxel") || found == scores.voxel_shifted.end()) return "";
    return rates(found->second) + "  on the grid shifted by half a voxel\n";
}

}  // namespace

std::vector<std::string> protocol_names() {
    std::vector<std::string> names{"all"};
    for (const Protocol& p : kProtocols) names.emplace_back(p.name);
    return names;
}

std::string protocol_table(const std::string& protocol, const eval::Scores& scores,
                           double voxel_size) {
    for (const Protocol& p : kProtocols) {
        if (protocol != p.name) continue;
        const std::string rule =
            fmt::format("{}: ", p.name) +
            fmt::format(fmt::runtime(p.rule), voxel_size, std::sqrt(3.0) / 2.0 * voxel_size) + "\n";
        const auto& points = scores.point;
        if (protocol == "mos") return rule + fmt::format("moving IoU {} %\n", percent(points.iou));
        if (protocol == "benchmark") {
            return rule + fmt::format("SA {} %  DA {} %  AA {} %  HA {} %\n", percent(points.sa),
                                      percent(points.da), percent(points.aa), percent(points.ha));
        }
        return rule + rates(scores.voxel.at(p.reading)) + "\n" + on_shifted_grid(p, scores);
    }
    return table(scores);
}

}  // namespace dynamic_filter::app
