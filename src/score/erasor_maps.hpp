// SPDX-License-Identifier: MIT
/// The scores of ERASOR (Lim et al., RA-L 2021), by the steps of its map generator and its scripts:
/// thinned maps whose points carry one label each, compared by nearest neighbours.
#pragma once

#include "dynamic_filter/scores.hpp"

namespace dynamic_filter::eval {

/// A map whose points carry a label each; static or dynamic. Both are parallel.
struct LabelledMap {
    Points points;  ///< [m]
    Labels labels;
};

/// One point for each voxel of `voxel_size` [m]: the centroid of its points, with the label of the
/// point of the map that is nearest to it, which may lie in another voxel.
LabelledMap thinned(const LabelledMap& map, double voxel_size);

/// Scores the verdicts of `scans` scans. Each scan is thinned, all of them are put together, and
/// that is thinned again: with all points for the true map, and with those that are not labelled
/// dynamic for the clean one. A point of the true map is kept if the nearest point of the clean map
/// is nearer than half the diagonal of a voxel, and has the same label. Points of unknown truth are
/// left out of both. Memory: the thinned scans.
VoxelTotals score_erasor(std::size_t scans, const ScanSource& source, double voxel_size);

/// The same of a clean map without labels: its points get the label of the nearest point of the
/// true map before that is thinned the second time, as ERASOR's tool for maps of others does.
VoxelTotals score_erasor(std::size_t scans, const ScanSource& source, const Points& map,
                         double voxel_size);

}  // namespace dynamic_filter::eval
