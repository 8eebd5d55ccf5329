// SPDX-License-Identifier: MIT
#include "dynamic_filter/geometry/voxel_index.hpp"

namespace dynamic_filter {

std::uint32_t VoxelIndex::insert(VoxelKey key) {
    if (const VoxelKey block = block_of(key); block != last_block_) {
        const auto [it, fresh] =
            number_of_block_.try_emplace(block, static_cast<std::uint32_t>(blocks_.size()));
        if (fresh) blocks_.push_back({.corner = block});
        last_block_ = block;
        last_number_ = it->second;
    }
    Block& block = blocks_[last_number_];
    const std::uint32_t place = place_of(key);
    if ((block.present >> place & 1U) == 0) {
        block.present |= std::uint64_t{1} << place;
        block.ids[place] = static_cast<std::uint32_t>(keys_.size());
        keys_.push_back(key);
    }
    return block.ids[place];
}

}  // namespace dynamic_filter
