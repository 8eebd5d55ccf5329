// SPDX-License-Identifier: MIT
/// @file
/// Sizes and counts of what a filter holds, for reports.
///
/// - Units: counts.
/// - Shapes: one Throughput per main stage.
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

/// How many items a stage has processed.
struct Throughput {
    std::string stage;      ///< name of the stage, as in StageTimes
    std::string item;       ///< what the stage processes: "scans" or "submaps"
    std::size_t count = 0;  ///< number of items
};

/// Contents of a filter.
struct MapContents {
    std::string observer;       ///< kind of the observers: "keyframes" or "submaps"
    std::size_t observers = 0;  ///< how many have observed, or are in the buffer
    std::size_t voxels = 0;     ///< number of voxels of the map
    /// Angles between the beams of the sensor; empty: not measured yet.
    std::optional<BeamPattern> beams;
    /// Scan::index of the keyframes that VoxelHistory::free_keyframes can name.
    std::vector<std::size_t> keyframes;
    std::vector<Throughput> throughput;  ///< one entry per main stage, in processing order

    /// Adds the contents of another map of the same method.
    void add(const MapContents& other);
};

}  // namespace dynamic_filter
