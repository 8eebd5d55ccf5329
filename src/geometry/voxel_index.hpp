// SPDX-License-Identifier: MIT
/// Assigns consecutive numbers to voxels.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/voxel.hpp"

namespace dynamic_filter {

/// The voxel of each point of a scan, parallel to the points; kNoVoxel: no voxel.
using PointVoxels = std::vector<std::uint32_t>;

/// Voxel keys of points. Points without a key are left out.
struct KeyedPoints {
    std::vector<VoxelKey> keys;
    std::vector<std::uint32_t> points;  ///< parallel to the keys: the index of the point
};
/// `inverse_size` [1/m] is 1 / edge of a voxel.
KeyedPoints keys_of(std::span<const Point> points, float inverse_size);

/// Hash table from the first cell of a block to the number of the block. It uses open addressing
/// and is at most half full.
class BlockTable {
public:
    /// Prefetches the memory that find() or insert() will read.
    void prefetch(VoxelKey corner) const { __builtin_prefetch(&slots_[slot_of(corner)]); }
    /// Returns kNoVoxel if the block is not in the table.
    [[nodiscard]] std::uint32_t find(VoxelKey corner) const { return slots_[at(corner)].number; }
    /// Returns the number of the block. A new block gets the number `next`.
    std::uint32_t insert(VoxelKey corner, std::uint32_t next);

private:
    struct Slot {
        VoxelKey corner = 0;
        std::uint32_t number = kNoVoxel;  // kNoVoxel: the slot is empty
    };
    [[nodiscard]] std::size_t slot_of(VoxelKey corner) const {
        return VoxelHash{}(corner) & (slots_.size() - 1);
    }
    /// Returns the slot of the block, or the empty slot into which it would go.
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

/// Numbers voxels in the order in which they are first inserted, so that callers can keep data of
/// voxels in plain arrays. Voxels are stored in blocks of 4 x 4 x 4: neighbors in space are
/// neighbors in memory, and one lookup in the hash table finds all voxels of a block. Const members
/// may run in several threads.
class VoxelIndex {
public:
    std::uint32_t insert(VoxelKey key);
    /// Inserts many voxels in their order; `ids` is parallel to `keys`. This is faster than single
    /// insertions because it prefetches.
    void insert(std::span<const VoxelKey> keys, std::span<std::uint32_t> ids);

    /// Renumbers the voxels from `first` on so that the voxels of a block have consecutive numbers.
    /// Returns the new number of each, in the order of the old numbers; the caller must reorder its
    /// arrays.
    std::vector<std::uint32_t> group_by_block(std::uint32_t first);

    [[nodiscard]] std::optional<std::uint32_t> find(VoxelKey key) const {
        const std::uint32_t block = table_.find(block_of(key));
        const std::uint32_t id = block == kNoVoxel ? kNoVoxel : id_in(blocks_[block], key);
        return id == kNoVoxel ? std::nullopt : std::optional(id);
    }
    /// Finds many voxels: `ids` is parallel to `keys`; kNoVoxel: the voxel is not in the index.
    void find(std::span<const VoxelKey> keys, std::span<std::uint32_t> ids) const;
    /// Prefetches the memory that each_in_block() will read.
    void prefetch_block(std::uint32_t block) const {
        constexpr std::size_t kLine = 64;  // bytes of a cache line
        const char* const begin = reinterpret_cast<const char*>(&blocks_[block]);
        for (std::size_t at = 0; at < sizeof(Block); at += kLine) __builtin_prefetch(begin + at);
    }
    /// Prefetches the first memory that find() of this key will read.
    void prefetch(VoxelKey key) const { table_.prefetch(block_of(key)); }
    [[nodiscard]] VoxelKey key(std::uint32_t id) const { return keys_[id]; }
    [[nodiscard]] std::size_t size() const { return keys_.size(); }

    /// Number of blocks. Blocks, too, are numbered in the order in which they are first inserted.
    [[nodiscard]] std::size_t blocks() const { return blocks_.size(); }
    [[nodiscard]] std::uint32_t block_of_voxel(std::uint32_t id) const {
        return block_of_voxel_[id];
    }
    /// The first of the 4 x 4 x 4 cells of the block.
    [[nodiscard]] Cell corner(std::uint32_t block) const { return unpack(corners_[block]); }
    /// Calls use(id) for every voxel of the block.
    template <class Use>
    void each_in_block(std::uint32_t block, const Use& use) const {
        each_in_block(block, ~std::uint64_t{0}, [&](std::uint32_t id, int) { use(id); });
    }
    /// Calls use(id, place) for those voxels of the block whose place is a set bit of `wanted`. The
    /// place is 16 x + 4 y + z, counted from the corner of the block.
    template <class Use>
    void each_in_block(std::uint32_t block, std::uint64_t wanted, const Use& use) const {
        const Block& b = blocks_[block];
        for (std::uint64_t left = b.present & wanted; left != 0; left &= left - 1) {
            const int place = std::countr_zero(left);
            use(b.ids[static_cast<std::size_t>(place)], place);
        }
    }
    /// The number of the block whose first cell is `corner`; empty if there is none.
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
