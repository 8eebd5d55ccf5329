// SPDX-License-Identifier: MIT
/// Numbers for voxels.
#pragma once

#include <tsl/robin_map.h>

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "dynamic_filter/geometry/voxel.hpp"

namespace dynamic_filter {

/// The voxel of each point of a scan; kNoVoxel: none.
using PointVoxels = std::vector<std::uint32_t>;

/// The numbers of the blocks asked for last. A scan comes back to the same blocks with every ring
/// or column of it.
class BlockCache {
public:
    struct Entry {
        VoxelKey block = ~VoxelKey{0};
        std::uint32_t number = 0;
    };
    /// Where the block is, if it is here; the caller fills in what is not.
    Entry& at(VoxelKey block) { return entries_[block * 0x9E3779B97F4A7C15ULL >> 54]; }

private:
    std::vector<Entry> entries_ = std::vector<Entry>(1024);
};

/// Numbers voxels in the order in which they are first met: dense ids for plain arrays. Inside,
/// voxels live in blocks of 4 x 4 x 4: what is near is near in memory, and one look into the hash
/// table serves a whole block. Const members may run in several threads.
class VoxelIndex {
public:
    std::uint32_t insert(VoxelKey key);

    /// Renumbers the voxels from `first` on so that those of a block follow each other: near in
    /// the arrays of the caller, too. Returns the new number of each, in the order of the old.
    std::vector<std::uint32_t> group_by_block(std::uint32_t first);

    [[nodiscard]] std::optional<std::uint32_t> find(VoxelKey key) const {
        const auto block = find_block(block_of(key));
        const std::uint32_t id = block ? id_in(blocks_[*block], key) : kNoVoxel;
        return id == kNoVoxel ? std::nullopt : std::optional(id);
    }
    [[nodiscard]] VoxelKey key(std::uint32_t id) const { return keys_[id]; }
    [[nodiscard]] std::size_t size() const { return keys_.size(); }

    /// Blocks are numbered in the order in which they are first met, too.
    [[nodiscard]] std::size_t blocks() const { return blocks_.size(); }
    [[nodiscard]] std::uint32_t block_of_voxel(std::uint32_t id) const {
        return block_of_voxel_[id];
    }
    /// The first of its 4 x 4 x 4 cells.
    [[nodiscard]] Cell corner(std::uint32_t block) const { return unpack(blocks_[block].corner); }
    /// Calls use(id) for every voxel of the block.
    template <class Use>
    void each_in_block(std::uint32_t block, const Use& use) const {
        each_in_block(block, ~std::uint64_t{0}, [&](std::uint32_t id, int) { use(id); });
    }
    /// Calls use(id, place) for those whose place, 16 x + 4 y + z from the corner, is `wanted`.
    template <class Use>
    void each_in_block(std::uint32_t block, std::uint64_t wanted, const Use& use) const {
        const Block& b = blocks_[block];
        for (std::uint64_t left = b.present & wanted; left != 0; left &= left - 1) {
            const int place = std::countr_zero(left);
            use(b.ids[static_cast<std::size_t>(place)], place);
        }
    }
    /// The number of the block with this first cell.
    [[nodiscard]] std::optional<std::uint32_t> find_block(VoxelKey corner) const {
        const auto it = number_of_block_.find(corner);
        return it == number_of_block_.end() ? std::nullopt : std::optional(it->second);
    }

private:
    friend class VoxelFinder;
    struct Block {
        VoxelKey corner = 0;
        std::uint64_t present = 0;  // bit 16 x + 4 y + z
        std::array<std::uint32_t, 64> ids{};
    };
    static constexpr VoxelKey kInBlock = VoxelKey{3} << 42 | VoxelKey{3} << 21 | 3;

    static VoxelKey block_of(VoxelKey key) { return key & ~kInBlock; }
    static std::uint32_t place_of(VoxelKey key) {
        return static_cast<std::uint32_t>((key >> 38 & 48) | (key >> 19 & 12) | (key & 3));
    }
    static std::uint32_t id_in(const Block& block, VoxelKey key) {
        const std::uint32_t place = place_of(key);
        return (block.present >> place & 1U) != 0 ? block.ids[place] : kNoVoxel;
    }

    tsl::robin_map<VoxelKey, std::uint32_t, VoxelHash> number_of_block_;
    std::vector<Block> blocks_;
    std::vector<VoxelKey> keys_;
    std::vector<std::uint32_t> block_of_voxel_;
    BlockCache recent_;  // of insert()
};

/// Finds one voxel after another; quick while they share blocks. For one thread; the index must
/// outlive it and not grow meanwhile.
class VoxelFinder {
public:
    explicit VoxelFinder(const VoxelIndex& index) : index_(index) {}

    /// kNoVoxel: not there.
    std::uint32_t operator()(VoxelKey key) {
        const VoxelKey block = VoxelIndex::block_of(key);
        BlockCache::Entry& recent = recent_.at(block);
        if (recent.block != block) {
            recent = {block, index_.find_block(block).value_or(kNoVoxel)};
        }
        return recent.number == kNoVoxel ? kNoVoxel
                                         : index_.id_in(index_.blocks_[recent.number], key);
    }

private:
    const VoxelIndex& index_;
    BlockCache recent_;
};

}  // namespace dynamic_filter
