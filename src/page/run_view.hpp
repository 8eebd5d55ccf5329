// SPDX-License-Identifier: MIT
/// A finished run as the viewer shows it: its map, its scans one by one, and why.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/recording.hpp"
#include "objects/object_ways.hpp"
#include "page/page.hpp"
#include "page/shown.hpp"

namespace dynamic_filter::app {

/// Counts of a scan, made while its labels are written.
struct ScanNote {
    std::size_t index = 0;                               ///< in the recording
    std::size_t sensor = 0;                              ///< which of several made it
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] of the sensor, in the world
    double stamp = 0.0;                                  ///< [s]
    std::array<std::uint32_t, 3> counts{};               ///< final: static, dynamic, unknown
    std::uint32_t corrected = 0;  ///< points whose final verdict is not the instant one
    /// Dynamic kept as such, dynamic missed, static kept, static removed: final, then instant.
    std::array<std::uint32_t, 8> scores{};
};

/// Counts of one scan. `instant` and `truth` may be empty.
ScanNote note_of(const Labels& labels, const Labels& instant, const Labels& truth);

constexpr std::size_t kMostObjects = 1000;  ///< that a page lists

struct ViewInput {
    const io::Recording& recording;
    const std::vector<ScanNote>& scans;  ///< that were used, in order
    std::vector<std::string> sensors;    ///< names by ScanNote::sensor; one or none: not shown
    Shown shown;                         ///< of these scans
    std::vector<ObjectWay> objects;      ///< what moved: the largest
    std::size_t objects_total = 0;
    /// The evidence behind the verdicts.
    std::function<std::vector<VoxelHistory>(std::span<const std::uint64_t>)> histories;
    std::vector<std::size_t> keyframes;  ///< Scan::index
    bool has_evidence = false;           ///< scans observe, so there are counters
};

/// Arrays of the run, and the part of its `info` that goes with them.
PageRun view_of(const ViewInput& input);

/// Arrays of a cloud in the world frame, all points static.
PageRun view_of(const io::Cloud& cloud);

}  // namespace dynamic_filter::app
