// SPDX-License-Identifier: MIT
/// Finds the voxels around a voxel.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "geometry/voxel_index.hpp"

namespace dynamic_filter {

/// Stores which blocks of an index are adjacent, so that the voxels around a voxel are found
/// without the hash table. An object belongs to one index; call update() after voxels were
/// inserted. Const members may run in several threads.
class VoxelNeighbors {
public:
    /// Adds the blocks that are new in the index. Cost: the number of new blocks.
    void update(const VoxelIndex& index);

    /// Calls use(id, distance) for every voxel in a cube around a voxel, including the voxel
    /// itself. The cube reaches so many cells to each side, at most four. The order does not depend
    /// on the ids. The distance is the largest of the three coordinate differences, in cells.
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
    /// Calls use(id, cell) for every voxel of a block and of the cells around it, up to four cells
    /// to each side. The order does not depend on the ids. Cells are counted from the first cell of
    /// the block.
    template <class Use>
    void each_around(const VoxelIndex& index, int cells, std::uint32_t block,
                     const Use& use) const {
        each_in_box(index, block, Cell::Constant(-cells), Cell::Constant(3 + cells), use);
    }

    /// Prefetches the memory that prefetch() of this block will read.
    void prefetch_row(std::uint32_t block) const { __builtin_prefetch(&around_[block]); }
    /// Prefetches the memory that each_around() of this block will read.
    void prefetch(const VoxelIndex& index, std::uint32_t block) const {
        for (const std::uint32_t other : around_[block]) {
            if (other != kNoBlock) index.prefetch_block(other);
        }
    }

private:
    static constexpr std::uint32_t kNoBlock = UINT32_MAX;
    /// Index 9 x + 3 y + z; each coordinate is 0 (one block lower), 1 (the same) or 2 (one block
    /// higher).
    using Around = std::array<std::uint32_t, 27>;

    /// Bits of the places of a block whose coordinate on the axis lies in [low, high]. Neighbors on
    /// axis 0 are 16 bits apart, on axis 1 four bits, on axis 2 one bit.
    static std::uint64_t slab(int axis, int low, int high);
    /// Cells are counted from the first cell of the block. The box must lie within the block and
    /// its adjacent blocks.
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
    // Ranges along one axis in the block below, in the block itself and in the block above.
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
