// SPDX-License-Identifier: MIT
/// Submaps merging (Sec. III-D).
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/geometry/voxel_index.hpp"
#include "dynamic_filter/submaps_observe/occupancy.hpp"

namespace dynamic_filter {

/// The occupancy of every voxel, as the local map whose query pose is nearest to it sees it.
/// Arrays go by voxel id; a probability is empty where no local map knows the voxel.
struct MergedMap {
    std::vector<std::optional<float>> probability;
    std::vector<double> distance_sq;  ///< [m^2] from the voxel to the pose that decided
};

/// Lets `local` decide the voxels to which its pose is nearer than any before; ties: the earlier.
void merge(MergedMap& merged, const LocalMap& local, const Pose& T_map_query,
           const VoxelIndex& index, double voxel_size);

}  // namespace dynamic_filter
