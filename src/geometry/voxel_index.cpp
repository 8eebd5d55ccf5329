// SPDX-License-Identifier: MIT
#include "geometry/voxel_index.hpp"

#include <algorithm>
#include <utility>

namespace dynamic_filter {

namespace {

constexpr std::size_t kTogether = 32;  // number of keys that are prefetched together

}  // namespace

KeyedPoints keys_of(std::span<const Point> points, float inverse_size) {
    KeyedPoints keyed;
    keyed.keys.reserve(points.size());
    keyed.points.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const auto cell = cell_of(points[i], inverse_size);
        if (!cell) continue;
        keyed.keys.push_back(pack(*cell));
        keyed.points.push_back(i);
    }
    return keyed;
}

std::uint32_t BlockTable::insert(VoxelKey corner, std::uint32_t next) {
    std::size_t slot = at(corner);
    if (slots_[slot].number != kNoVoxel) return slots_[slot].number;
    if (2 * (filled_ + 1) > slots_.size()) {
        grow();
        slot = at(corner);
    }
    slots_[slot] = {corner, next};
    ++filled_;
    return next;
}

void BlockTable::grow() {
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
    for (const Slot& slot : old) {
        if (slot.number != kNoVoxel) slots_[at(slot.corner)] = slot;
    }
}

std::uint32_t VoxelIndex::block_with(VoxelKey corner) {
    const std::uint32_t block = table_.insert(corner, static_cast<std::uint32_t>(blocks_.size()));
    if (block == blocks_.size()) {
        blocks_.emplace_back();
        corners_.push_back(corner);
    }
    return block;
}

std::uint32_t VoxelIndex::insert_in(std::uint32_t block, VoxelKey key) {
    Block& b = blocks_[block];
    const std::uint32_t place = place_of(key);
    if ((b.present >> place & 1U) == 0) {
        b.present |= std::uint64_t{1} << place;
        b.ids[place] = static_cast<std::uint32_t>(keys_.size());
        keys_.push_back(key);
        block_of_voxel_.push_back(block);
    }
    return b.ids[place];
}

std::uint32_t VoxelIndex::insert(VoxelKey key) { return insert_in(block_with(block_of(key)), key); }

void VoxelIndex::insert(std::span<const VoxelKey> keys, std::span<std::uint32_t> ids) {
    std::array<std::uint32_t, kTogether> blocks{};
    for (std::size_t begin = 0; begin < keys.size(); begin += kTogether) {
        const auto some = keys.subspan(begin, std::min(kTogether, keys.size() - begin));
        for (const VoxelKey key : some) prefetch(key);
        for (std::size_t i = 0; i < some.size(); ++i) {
            blocks[i] = block_with(block_of(some[i]));
            prefetch_in(blocks[i], some[i]);
        }
        for (std::size_t i = 0; i < some.size(); ++i)
            ids[begin + i] = insert_in(blocks[i], some[i]);
    }
}

void VoxelIndex::find(std::span<const VoxelKey> keys, std::span<std::uint32_t> ids) const {
    std::array<std::uint32_t, kTogether> blocks{};
    for (std::size_t begin = 0; begin < keys.size(); begin += kTogether) {
        const auto some = keys.subspan(begin, std::min(kTogether, keys.size() - begin));
        for (const VoxelKey key : some) prefetch(key);
        for (std::size_t i = 0; i < some.size(); ++i) {
            blocks[i] = table_.find(block_of(some[i]));
            if (blocks[i] != kNoVoxel) prefetch_in(blocks[i], some[i]);
        }
        for (std::size_t i = 0; i < some.size(); ++i) {
            ids[begin + i] = blocks[i] == kNoVoxel ? kNoVoxel : id_in(blocks_[blocks[i]], some[i]);
        }
    }
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
