// SPDX-License-Identifier: MIT
/// Numbers for voxels.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/geometry/voxel.hpp"

namespace dynamic_filter {

/// The voxel of each point of a scan; kNoVoxel: none.
using PointVoxels = std::vector<std::uint32_t>;

/// The keys of points, as far as they have one.
struct KeyedPoints {
    std::vector<VoxelKey> keys;
    std::vector<std::uint32_t> points;  ///< which point each key is of
};
/// `inverse_size` [1/m] of the voxels.
KeyedPoints keys_of(std::span<const Point> points, float inverse_size);

/// Finds the number of a block by its first cell: open addressing, at most half full.
class BlockTable {
public:
    /// Prefetches what find() or insert() will read.
    void prefetch(VoxelKey corner) const { __builtin_prefetch(&slots_[slot_of(corner)]); }
    /// kNoVoxel: not there.
    [[nodiscard]] std::uint32_t find(VoxelKey corner) const { return slots_[at(corner)].number; }
    /// The number of the block, which is `next` if it was not there.
    std::uint32_t insert(VoxelKey corner, std::uint32_t next);

private:
    struct Slot {
        VoxelKey corner = 0;
        std::uint32_t number = kNoVoxel;  // kNoVoxel: empty
    };
    [[nodiscard]] std::size_t slot_of(VoxelKey corner) const {
        return VoxelHash{}(corner) & (slots_.size() - 1);
    }
    /// Where the block is, or the empty slot where it would be.
    [[nodiscard]] std::size_t at(VoxelKey corner) const {
        std::size_t slot = slot_of(corner);
        while (slots_[slot].number != kNoVoxel && slots_[slot].corner != corner) {
            slot = (slot + 1) & (slots_.size() - 1);
        }
        return slot;
    }
    void grow();

    std::vector<Slot> slots_ = std::vector<Slot>(64);  // a power of two
    std::size_t filled_ = 0;
};

/// Numbers voxels in the order in which they are first met: dense ids for plain arrays. Inside,
/// voxels live in blocks of 4 x 4 x 4: what is near is near in memory, and one look into the hash
/// table serves a whole block. Const members may run in several threads.
class VoxelIndex {
public:
    std::uint32_t insert(VoxelKey key);
    /// The same for many, in their order: `ids` is parallel to `keys`. Quicker than one by one,
    /// because it prefetches.
    void insert(std::span<const VoxelKey> keys, std::span<std::uint32_t> ids);

    /// Renumbers the voxels from `first` on so that those of a block follow each other: near in
    /// the arrays of the caller, too. Returns the new number of each, in the order of the old.
    std::vector<std::uint32_t> group_by_block(std::uint32_t first);

    [[nodiscard]] std::optional<std::uint32_t> find(VoxelKey key) const {
        const std::uint32_t block = table_.find(block_of(key));
        const std::uint32_t id = block == kNoVoxel ? kNoVoxel : id_in(blocks_[block], key);
        return id == kNoVoxel ? std::nullopt : std::optional(id);
    }
    /// The same for many: `ids` is parallel to `keys`; kNoVoxel: not there.
    void find(std::span<const VoxelKey> keys, std::span<std::uint32_t> ids) const;
    /// Prefetches what each_in_block() will read.
    void prefetch_block(std::uint32_t block) const {
        constexpr std::size_t kLine = 64;  // bytes of the cache
        const char* const begin = reinterpret_cast<const char*>(&blocks_[block]);
        for (std::size_t at = 0; at < sizeof(Block); at += kLine) __builtin_prefetch(begin + at);
    }
    /// Prefetches what find() of this key will read first.
    void prefetch(VoxelKey key) const { table_.prefetch(block_of(key)); }
    [[nodiscard]] VoxelKey key(std::uint32_t id) const { return keys_[id]; }
    [[nodiscard]] std::size_t size() const { return keys_.size(); }

    /// Blocks are numbered in the order in which they are first met, too.
    [[nodiscard]] std::size_t blocks() const { return blocks_.size(); }
    [[nodiscard]] std::uint32_t block_of_voxel(std::uint32_t id) const {
        return block_of_voxel_[id];
    }
    /// The first of its 4 x 4 x 4 cells.
    [[nodiscard]] Cell corner(std::uint32_t block) const { return unpack(corners_[block]); }
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
        const std::uint32_t block = table_.find(corner);
        return block == kNoVoxel ? std::nullopt : std::optional(block);
    }

private:
    struct Block {
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

    void prefetch_in(std::uint32_t block, VoxelKey key) const {
        __builtin_prefetch(&blocks_[block].present);
        __builtin_prefetch(&blocks_[block].ids[place_of(key)]);
    }
    std::uint32_t block_with(VoxelKey corner);
    std::uint32_t insert_in(std::uint32_t block, VoxelKey key);

    BlockTable table_;
    std::vector<Block> blocks_;
    std::vector<VoxelKey> corners_;  // by block
    std::vector<VoxelKey> keys_;
    std::vector<std::uint32_t> block_of_voxel_;
};

}  // namespace dynamic_filter
