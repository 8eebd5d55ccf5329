// SPDX-License-Identifier: MIT
/// Numbers for voxels, and the voxels around a voxel.
#pragma once

#include <tsl/robin_map.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "dynamic_filter/geometry/voxel.hpp"

namespace dynamic_filter {

constexpr std::uint32_t kNoVoxel = UINT32_MAX;

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

    [[nodiscard]] std::optional<std::uint32_t> find(VoxelKey key) const {
        const Block* block = find_block(block_of(key));
        const std::uint32_t id = block == nullptr ? kNoVoxel : id_in(*block, key);
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
        for (std::uint64_t left = blocks_[block].present; left != 0; left &= left - 1) {
            use(blocks_[block].ids[static_cast<std::size_t>(std::countr_zero(left))]);
        }
    }

    /// Calls use(id, distance) for every voxel in the cube of so many cells around `home`, itself
    /// too, in an order that does not depend on the ids. Distance in cells, that of the farthest
    /// axis.
    template <class Use>
    void each_within(int cells, VoxelKey home, const Use& use) const {
        const Cell center = unpack(home);
        each_in_box(center.array() - cells, center.array() + cells,
                    [&](std::uint32_t id, const Cell& cell) {
                        use(id, (cell - center).cwiseAbs().maxCoeff());
                    });
    }
    /// Calls use(id, cell) for every voxel in the box from `low` to `high`, both included, in an
    /// order that does not depend on the ids.
    template <class Use>
    void each_in_box(const Cell& low, const Cell& high, const Use& use) const;

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
    [[nodiscard]] std::uint32_t number_of(const Block& block) const {
        return static_cast<std::uint32_t>(&block - blocks_.data());
    }
    [[nodiscard]] const Block* find_block(VoxelKey block) const {
        const auto it = number_of_block_.find(block);
        return it == number_of_block_.end() ? nullptr : &blocks_[it->second];
    }
    /// Places of a block whose coordinate on the axis lies in [low, high]; bits of axis 0 are 16
    /// apart, of axis 1 four, of axis 2 one.
    static std::uint64_t slab(int axis, int low, int high);

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
            const VoxelIndex::Block* found = index_.find_block(block);
            recent = {block, found == nullptr ? kNoVoxel : index_.number_of(*found)};
        }
        return recent.number == kNoVoxel ? kNoVoxel
                                         : index_.id_in(index_.blocks_[recent.number], key);
    }

private:
    const VoxelIndex& index_;
    BlockCache recent_;
};

inline std::uint64_t VoxelIndex::slab(int axis, int low, int high) {
    constexpr std::array<std::uint64_t, 3> kOne = {0xFFFF, 0x000F'000F'000F'000F,
                                                   0x1111'1111'1111'1111};
    const int apart = 16 >> 2 * axis;
    std::uint64_t places = 0;
    for (int at = low; at <= high; ++at) {
        places |= kOne[static_cast<std::size_t>(axis)] << apart * at;
    }
    return places;
}

template <class Use>
void VoxelIndex::each_in_box(const Cell& low, const Cell& high, const Use& use) const {
    const auto part = [](int axis, int block, int from, int to) {  // of a block along an axis
        return slab(axis, std::max(from - 4 * block, 0), std::min(to - 4 * block, 3));
    };
    const Cell from = low.cwiseMax(-kCellLimit), to = high.cwiseMin(kCellLimit - 1);
    const Cell first = from.unaryExpr([](int c) { return c >> 2; });
    const Cell last = to.unaryExpr([](int c) { return c >> 2; });
    for (int x = first.x(); x <= last.x(); ++x) {
        const std::uint64_t in_x = part(0, x, from.x(), to.x());
        for (int y = first.y(); y <= last.y(); ++y) {
            const std::uint64_t in_xy = in_x & part(1, y, from.y(), to.y());
            for (int z = first.z(); z <= last.z(); ++z) {
                const Cell corner(4 * x, 4 * y, 4 * z);
                const Block* block = find_block(pack(corner));
                if (block == nullptr) continue;
                std::uint64_t places = block->present & in_xy & part(2, z, from.z(), to.z());
                for (; places != 0; places &= places - 1) {
                    const int place = std::countr_zero(places);
                    use(block->ids[static_cast<std::size_t>(place)],
                        Cell(corner + Cell(place >> 4, place >> 2 & 3, place & 3)));
                }
            }
        }
    }
}

}  // namespace dynamic_filter
