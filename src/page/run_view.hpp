// SPDX-License-Identifier: MIT
/// A finished run as the viewer shows it: its map, its scans one by one, and why.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <vector>

#include "dynamic_filter/online.hpp"
#include "dynamic_filter/recording.hpp"
#include "page/page.hpp"
#include "page/thinned_cloud.hpp"
#include "run/label_store.hpp"

namespace dynamic_filter::app {

/// Counts of a scan, made while its labels are written.
struct ScanNote {
    std::size_t index = 0;                               ///< in the recording
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] of the sensor, in the world
    double stamp = 0.0;                                  ///< [s]
    std::array<std::uint32_t, 3> counts{};               ///< final: static, dynamic, unknown
    std::uint32_t corrected = 0;  ///< points whose final verdict is not the instant one
    /// Dynamic kept as such, dynamic missed, static kept, static removed: final, then instant.
    std::array<std::uint32_t, 8> scores{};
};

/// Counts of one scan. `instant` and `truth` may be empty.
ScanNote note_of(const Labels& labels, const Labels& instant, const Labels& truth);

struct ViewInput {
    const io::Recording& sequence;
    const OnlineFilter& filter;          ///< finished
    const std::vector<ScanNote>& scans;  ///< that were used, in order
    const LabelStore& instant;           ///< by index in the recording; empty where not kept
    std::filesystem::path labels;        ///< folder of the final verdicts
    bool has_evidence = false;           ///< scans observe, so there are counters
};

/// Arrays of the run, and the part of its `info` that goes with them. Reads the scans again.
PageRun view_of(const ViewInput& input);

/// True if the page plays scan `index` of `scans` scans.
bool is_shown(std::size_t index, std::size_t scans);

/// Arrays of a cloud in the world frame, all points static.
PageRun view_of(const io::Cloud& cloud);

}  // namespace dynamic_filter::app
