// SPDX-License-Identifier: MIT
/// Final verdicts: the decision on every voxel, and the moving points within static voxels.
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/settings.hpp"
#include "filter/contact.hpp"
#include "filter/evidence_grid.hpp"
#include "filter/method.hpp"

namespace dynamic_filter {

/// The decision on a voxel.
struct VoxelDecision {
    std::optional<float> probability;  ///< probability of being occupied; empty: unknown
    /// Static surface, if a static voxel touches a dynamic one.
    std::optional<ContactSurface> contact;
};

/// Decides every voxel of the grid. Runs in parallel.
std::vector<VoxelDecision> decide_voxels(const EvidenceGrid& grid, const Config& config);

/// For each dynamic voxel: the scan (in the order of the scans) from which on the voxel is occupied
/// until the end of the recording. It is empty unless that last run has as many keyframes as are
/// counted per run (see record()), and points in as many scans. Used for `map.time` = latest.
std::vector<std::optional<std::uint32_t>> occupied_since(const std::vector<VoxelDecision>& decided,
                                                         const EvidenceGrid& grid,
                                                         const Config& config);

/// Writes the labels and probabilities of the points of a scan. A point of a static voxel is
/// dynamic if it lies above the static surface of the voxel, and if a dynamic voxel nearby has
/// points in the same scan. Thread-safe.
void decide_points(const LocatedScan& scan, const std::vector<VoxelDecision>& decided,
                   const EvidenceGrid& grid, const Config& config, Verdict& verdict);

}  // namespace dynamic_filter
