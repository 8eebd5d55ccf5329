// SPDX-License-Identifier: MIT
/// The occupancy of a voxel, from its own evidence and from that of its neighbors.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/settings.hpp"
#include "filter/evidence_grid.hpp"

namespace dynamic_filter {

/// Computes the occupancy 0..1 of voxels from the sum of three scores. The first is the score of
/// the voxel itself. The second is the mean over the voxels within two cells that had points at the
/// same time, because the parts of an object appear and disappear together. The third is the mean
/// over all voxels within two cells, because surfaces continue and people walk where others walked.
/// Neighbors that were observed often have more weight in both means.
///
/// A voxel without evidence of its own gets the occupancy of its neighbors; the result is empty if
/// they have no evidence either. If points of a voxel belonged to moving objects, its occupancy is
/// at most the share of its other scans. Runs in parallel and uses only const members of the grid.
/// vote_scalar.hpp defines the vote; source: docs/how-it-works.md, "Neighbours vote".
std::vector<std::optional<float>> occupancy_of(const EvidenceGrid& grid,
                                               std::span<const std::uint32_t> voxels,
                                               const ScansConfig& config);

}  // namespace dynamic_filter
