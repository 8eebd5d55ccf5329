// SPDX-License-Identifier: MIT
/// The inner loop that takes points to the map and to their voxels, compiled once per
/// instruction-set level from voxel_kernel.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "best_kernel.hpp"

namespace dynamic_filter::kernel {

struct VoxelArgs {
    const float* xyz = nullptr;  ///< count * 3
    std::size_t count = 0;
    const float* matrix = nullptr;  ///< row-major 3x4
    float half_cells_per_metre = 0.0F;
    bool origin_is_a_point = false;
    float* map_xyz = nullptr;       ///< count * 3
    std::uint64_t* keys = nullptr;  ///< all ones: none
};

DYNAMIC_FILTER_DECLARE_KERNEL(void, to_voxels, VoxelArgs)

}  // namespace dynamic_filter::kernel
