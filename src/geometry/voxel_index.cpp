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

std::vector<std::uint32_t> VoxelIndex::group_by_block(std::uint32_t first) {
    const std::vector<VoxelKey> keys(keys_.begin() + first, keys_.end());
    const std::vector<std::uint32_t> blocks(block_of_voxel_.begin() + first, block_of_voxel_.end());
    std::vector<std::uint32_t> renumbered(keys.size(), kNoVoxel);
    std::uint32_t next = first;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (renumbered[i] != kNoVoxel) continue;
        Block& block = blocks_[blocks[i]];
        for (std::uint64_t left = block.present; left != 0; left &= left - 1) {
            std::uint32_t& id = block.ids[static_cast<std::size_t>(std::countr_zero(left))];
            if (id < first) continue;
            renumbered[id - first] = next;
            keys_[next] = keys[id - first];
            block_of_voxel_[next] = blocks[i];
            id = next++;
        }
    }
    return renumbered;
}

}  // namespace dynamic_filter
