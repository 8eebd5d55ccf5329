// SPDX-License-Identifier: MIT
/// @file
/// What a filter holds, for reports.
///
/// - Units: counts.
/// - Shapes: a Throughput per main stage.
/// - Ownership: values.
/// - Threads: plain data.
/// - Errors: none.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/geometry/range_image.hpp"

namespace dynamic_filter {

/// How much of something a stage has done.
struct Throughput {
    std::string stage;      ///< as in StageTimes
    std::string item;       ///< "scans", "submaps"
    std::size_t count = 0;  ///< of them
};

/// What a filter holds.
struct MapContents {
    std::string observer;                ///< what observes: "keyframes" or "submaps"
    std::size_t observers = 0;           ///< how many have observed, or are buffered
    std::size_t voxels = 0;              ///< of the map
    std::optional<BeamPattern> beams;    ///< how densely the sensor looks; empty: not known yet
    std::vector<std::size_t> keyframes;  ///< Scan::index of those that
                                         ///< VoxelHistory::free_keyframes knows
    std::vector<Throughput> throughput;  ///< of the main stages, in their order

    /// Adds those of another map of the same method.
    void add(const MapContents& other);
};

}  // namespace dynamic_filter
