// SPDX-License-Identifier: MIT
/// Submaps merging (Sec. III-D).
#pragma once

#include <vector>

#include "dynamic_filter/back_end/occupancy.hpp"
#include "dynamic_filter/geometry/voxel_index.hpp"

namespace dynamic_filter {

/// The occupancy of every voxel, as the local map whose query pose is nearest to it sees it.
/// Arrays go by voxel id; probability -1: no local map has an opinion.
struct MergedMap {
    std::vector<float> probability;
    std::vector<double> distance_sq;  ///< [m^2] from the voxel to the pose that decided
};

/// Lets `local` decide the voxels to which its pose is nearer than any before; ties: the earlier.
void merge(MergedMap& merged, const LocalMap& local, const Pose& T_map_query,
           const VoxelIndex& index, double voxel_size);

}  // namespace dynamic_filter
