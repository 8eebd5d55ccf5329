// SPDX-License-Identifier: MIT
/// The occupancy grid model (Sec. III-C1): the occupancy of a voxel is n_occ / n_check.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/voxel_index.hpp"
#include "paper/submap_buffer.hpp"
#include "paper/visibility_check.hpp"

namespace dynamic_filter {

/// The local map around a query pose: the voxels of the nearby submaps and their occupancy.
struct LocalMap {
    std::vector<std::uint32_t> voxels;  ///< voxel ids
    std::vector<float> probability;     ///< n_occ / n_check, parallel to `voxels`
};

/// The voxels in which nearby submaps have points. Bit j of `owners` is set if nearby[j] has a
/// point in the voxel, so n_occ is the number of set bits. Voxels are in the order in which they
/// are first met. At most 64 submaps.
struct Ownership {
    std::vector<std::uint32_t> voxels;
    std::vector<std::uint64_t> owners;
};

/// `slot_of_voxel` is a work array with one entry per voxel of the index; it is all zero before and
/// after the call.
Ownership count_owners(std::span<const BufferedSubmap* const> nearby,
                       std::vector<std::uint32_t>& slot_of_voxel);

/// Computes n_occ / n_check of each owned voxel (Sec. III-C1). A submap counts in n_check if it
/// owns the voxel, or if its visibility boundary, in the pixel of the voxel, reaches the depth
/// channel of the voxel.
LocalMap occupancy(Ownership ownership, std::span<const VisibilityBoundary> boundaries,
                   const VoxelIndex& index, float voxel_size, const Pose& T_map_query,
                   const ImageGrid& grid, const BackEndConfig& config);

}  // namespace dynamic_filter
