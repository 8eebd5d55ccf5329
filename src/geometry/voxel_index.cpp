// SPDX-License-Identifier: MIT
#include "dynamic_filter/geometry/voxel_index.hpp"

namespace dynamic_filter {

std::uint32_t VoxelIndex::insert(VoxelKey key) {
    const VoxelKey corner = block_of(key);
    BlockCache::Entry& recent = recent_.at(corner);
    if (recent.block != corner) {
        const auto [it, fresh] =
            number_of_block_.try_emplace(corner, static_cast<std::uint32_t>(blocks_.size()));
        if (fresh) blocks_.push_back({.corner = corner});
        recent = {corner, it->second};
    }
    Block& block = blocks_[recent.number];
    const std::uint32_t place = place_of(key);
    if ((block.present >> place & 1U) == 0) {
        block.present |= std::uint64_t{1} << place;
        block.ids[place] = static_cast<std::uint32_t>(keys_.size());
        keys_.push_back(key);
        block_of_voxel_.push_back(recent.number);
    }
    return block.ids[place];
}

}  // namespace dynamic_filter
