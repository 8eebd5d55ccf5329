// SPDX-License-Identifier: MIT
/// Merging of local maps (Sec. III-D).
#pragma once

#include <optional>
#include <vector>

#include "geometry/voxel_index.hpp"
#include "paper/occupancy.hpp"

namespace dynamic_filter {

/// The occupancy of every voxel, taken from the local map whose query pose is nearest to the voxel.
/// Arrays are indexed by voxel id. A probability is empty if no local map knows the voxel.
struct MergedMap {
    std::vector<std::optional<float>> probability;
    std::vector<double> distance_sq;  ///< [m^2] from the voxel to the pose whose local map decided
};

/// Merges a local map: it decides the voxels to which its pose is nearer than all previous poses
/// (Sec. III-D). On a tie, the earlier pose decides.
void merge(MergedMap& merged, const LocalMap& local, const Pose& T_map_query,
           const VoxelIndex& index, double voxel_size);

}  // namespace dynamic_filter
