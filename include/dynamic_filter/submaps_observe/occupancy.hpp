// SPDX-License-Identifier: MIT
/// The occupancy grid model (Sec. III-C1): n_occ / n_check per voxel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dynamic_filter/geometry/voxel_index.hpp"
#include "dynamic_filter/submaps_observe/submap_buffer.hpp"
#include "dynamic_filter/submaps_observe/visibility_check.hpp"

namespace dynamic_filter {

/// The local map around a query pose: what its submaps own, and how surely it is occupied.
struct LocalMap {
    std::vector<std::uint32_t> voxels;  ///< ids
    std::vector<float> probability;     ///< n_occ / n_check, parallel to voxels
};

/// The voxels that the nearby submaps own, with one bit per owner (bit j: nearby[j]), so that
/// n_occ = popcount. Voxels come in the order in which they are first met; at most 64 submaps.
struct Ownership {
    std::vector<std::uint32_t> voxels;
    std::vector<std::uint64_t> owners;
};

/// `slot_of_voxel` is scratch as long as the voxel index, all zero before and after.
Ownership count_owners(std::span<const BufferedSubmap* const> nearby,
                       std::vector<std::uint32_t>& slot_of_voxel);

/// n_occ / n_check per owned voxel. A submap counts in n_check if its boundary reaches the voxel's
/// depth channel in the voxel's pixel, or if it owns the voxel.
LocalMap occupancy(Ownership ownership, std::span<const VisibilityBoundary> boundaries,
                   const VoxelIndex& index, float voxel_size, const Pose& T_map_query,
                   const ImageGrid& grid, const BackEndConfig& config);

}  // namespace dynamic_filter
