// SPDX-License-Identifier: MIT
/// The occupancy of a voxel: its own evidence, and that of its neighbours.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/scans_observe/config.hpp"
#include "dynamic_filter/scans_observe/evidence_grid.hpp"

namespace dynamic_filter {

/// Occupancy 0..1 of voxels, from the sum of three scores: their own, the mean of those within two
/// cells that were there when they were there (things come and go as a whole), and the mean of all
/// within two cells (surfaces go on, and people walk where others did). The mean is weighted by how
/// often the neighbours were looked at. A voxel about which nothing is known itself is what its
/// neighbours are; empty: nothing is known of them either. Where the points of a voxel were part of
/// what moves, it is no more occupied than the share of the other scans says. In parallel; const
/// members of the grid only. vote_scalar.hpp says what a vote is.
std::vector<std::optional<float>> occupancy_of(const EvidenceGrid& grid,
                                               std::span<const std::uint32_t> voxels,
                                               const ScansConfig& config);

}  // namespace dynamic_filter
