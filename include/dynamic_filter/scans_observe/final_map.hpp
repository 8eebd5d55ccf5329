// SPDX-License-Identifier: MIT
/// The final verdicts: what every voxel is, and which points of a static one move all the same.
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/config.hpp"
#include "dynamic_filter/method.hpp"
#include "dynamic_filter/scans_observe/contact.hpp"
#include "dynamic_filter/scans_observe/evidence_grid.hpp"

namespace dynamic_filter {

/// What was decided of a voxel.
struct VoxelDecision {
    std::optional<float> probability;  ///< of being occupied; empty: unknown
    std::optional<Surface> contact;    ///< of a static voxel that touches a dynamic one
};

/// Decides every voxel of the grid. In parallel.
std::vector<VoxelDecision> decide_voxels(const EvidenceGrid& grid, const Config& config);

/// By dynamic voxel: the first scan, by their order, from which on it is occupied until the end,
/// for as many keyframes as count of one run (see record()), with points in as many scans; empty:
/// it is not.
std::vector<std::optional<std::uint32_t>> occupied_since(const std::vector<VoxelDecision>& decided,
                                                         const EvidenceGrid& grid,
                                                         const Config& config);

/// Fills in the labels and probabilities of a scan's points. A point of a static voxel is dynamic
/// if it lies above the static surface of its voxel while, in this very scan, something dynamic
/// touches the voxel. Thread-safe.
void decide_points(const LocatedScan& scan, const std::vector<VoxelDecision>& decided,
                   const EvidenceGrid& grid, const Config& config, Verdict& verdict);

}  // namespace dynamic_filter
