// SPDX-License-Identifier: MIT
/// The inner loop that transforms points into the map and finds their voxels. voxel_kernel.cpp is
/// compiled once per instruction-set level.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/best_kernel.hpp"

namespace dynamic_filter::kernel {

struct VoxelArgs {
    const float* xyz = nullptr;  ///< 3 * count values
    std::size_t count = 0;
    const float* matrix = nullptr;  ///< row-major 3x4
    float half_cells_per_metre = 0.0F;
    bool origin_is_a_point = false;
    float* map_xyz = nullptr;       ///< 3 * count values
    std::uint64_t* keys = nullptr;  ///< all bits set: no key
};

DYNAMIC_FILTER_DECLARE_KERNEL(void, to_voxels, VoxelArgs)

}  // namespace dynamic_filter::kernel
