// SPDX-License-Identifier: MIT
/// The voxels around a voxel.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "dynamic_filter/geometry/voxel_index.hpp"

namespace dynamic_filter {

/// Which blocks of an index touch which, so that one finds the voxels around a voxel without the
/// hash table. Belongs to one index; update() it after voxels were inserted. Const members may run
/// in several threads.
class VoxelNeighbors {
public:
    /// Takes in the blocks that the index has met since. Cost: the new blocks.
    void update(const VoxelIndex& index);

    /// Calls use(id, distance) for every voxel in the cube of so many cells, at most four, around a
    /// voxel, itself too, in an order that does not depend on the ids. Distance in cells, that of
    /// the farthest axis.
    template <class Use>
    void each_within(const VoxelIndex& index, int cells, std::uint32_t voxel,
                     const Use& use) const {
        const std::uint32_t block = index.block_of_voxel(voxel);
        const Cell center = unpack(index.key(voxel)) - index.corner(block);
        each_in_box(index, block, center.array() - cells, center.array() + cells,
                    [&](std::uint32_t id, const Cell& cell) {
                        use(id, (cell - center).cwiseAbs().maxCoeff());
                    });
    }
    /// Calls use(id, cell) for every voxel of a block and of the cells, at most four, around it, in
    /// an order that does not depend on the ids; cells are counted from the block's first one.
    template <class Use>
    void each_around(const VoxelIndex& index, int cells, std::uint32_t block,
                     const Use& use) const {
        each_in_box(index, block, Cell::Constant(-cells), Cell::Constant(3 + cells), use);
    }

    /// Prefetches what prefetch() of this block will read.
    void prefetch_row(std::uint32_t block) const { __builtin_prefetch(&around_[block]); }
    /// Prefetches what each_around() of this block will read.
    void prefetch(const VoxelIndex& index, std::uint32_t block) const {
        for (const std::uint32_t other : around_[block]) {
            if (other != kNoBlock) index.prefetch_block(other);
        }
    }

private:
    static constexpr std::uint32_t kNoBlock = UINT32_MAX;
    /// [9 x + 3 y + z], each 0: one block lower, 1: the same, 2: one higher.
    using Around = std::array<std::uint32_t, 27>;

    /// Places of a block whose coordinate on the axis lies in [low, high]; bits of axis 0 are 16
    /// apart, of axis 1 four, of axis 2 one.
    static std::uint64_t slab(int axis, int low, int high);
    /// Cells are counted from the block's first one; the box lies within the block and those around
    /// it.
    template <class Use>
    void each_in_box(const VoxelIndex& index, std::uint32_t block, const Cell& low,
                     const Cell& high, const Use& use) const;

    std::vector<Around> around_;
};

inline std::uint64_t VoxelNeighbors::slab(int axis, int low, int high) {
    constexpr std::array<std::uint64_t, 3> kOne = {0xFFFF, 0x000F'000F'000F'000F,
                                                   0x1111'1111'1111'1111};
    const int apart = 16 >> 2 * axis;
    std::uint64_t places = 0;
    for (int at = std::max(low, 0); at <= std::min(high, 3); ++at) {
        places |= kOne[static_cast<std::size_t>(axis)] << apart * at;
    }
    return places;
}

template <class Use>
void VoxelNeighbors::each_in_box(const VoxelIndex& index, std::uint32_t block, const Cell& low,
                                 const Cell& high, const Use& use) const {
    // Places along an axis in the block below, the block itself and the one above.
    const auto parts = [&](int axis) {
        const auto of = [&](int first) {
            return slab(axis, low[axis] - first, high[axis] - first);
        };
        return std::array{of(-4), of(0), of(4)};
    };
    const auto in_x = parts(0), in_y = parts(1), in_z = parts(2);
    const Around& around = around_[block];
    for (std::size_t b = 0; b < around.size(); ++b) {
        const std::size_t x = b / 9, y = b / 3 % 3, z = b % 3;
        const std::uint64_t wanted = in_x[x] & in_y[y] & in_z[z];
        if (wanted == 0 || around[b] == kNoBlock) continue;
        const int from_x = 4 * static_cast<int>(x) - 4, from_y = 4 * static_cast<int>(y) - 4,
                  from_z = 4 * static_cast<int>(z) - 4;
        index.each_in_block(around[b], wanted, [&](std::uint32_t id, int place) {
            use(id, Cell(from_x + (place >> 4), from_y + (place >> 2 & 3), from_z + (place & 3)));
        });
    }
}

}  // namespace dynamic_filter
