// SPDX-License-Identifier: MIT
#include "geometry/voxel_neighbors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "support/cells.hpp"

namespace dynamic_filter {
namespace voxel_neighbors_test {

TEST(VoxelNeighbors, EachWithinIsTheCubeAroundACell) {
    const Cell last = Cell::Constant(kCellLimit - 1), first = Cell::Constant(-kCellLimit);
    for (const Cell& corner : {Cell(-7, -6, -5), Cell(100, -3, 8), Cell(last.array() - 6), first}) {
        VoxelIndex index;
        const auto cells = test::scattered(corner, 12, 3);
        VoxelNeighbors neighbors;  // taken in now and then
        for (std::size_t i = 0; i < cells.size(); ++i) {
            index.insert(pack(cells[i]));
            if (i % 97 == 0) neighbors.update(index);
        }
        neighbors.update(index);
        for (std::size_t i = 0; i < cells.size(); i += 5) {
            for (const int reach : {0, 1, 2, 4}) {
                std::map<std::uint32_t, int> expected, found;
                for (std::uint32_t v = 0; v < index.size(); ++v) {
                    const int distance = (unpack(index.key(v)) - cells[i]).cwiseAbs().maxCoeff();
                    if (distance <= reach) expected[v] = distance;
                }
                neighbors.each_within(index, reach, *index.find(pack(cells[i])),
                                      [&](std::uint32_t v, int distance) {
                                          EXPECT_TRUE(found.try_emplace(v, distance).second);
                                      });
                ASSERT_EQ(found, expected) << cells[i].transpose() << ", reach " << reach;
            }
        }
    }
}

TEST(VoxelNeighbors, EachWithinGoesByPlaceNotById) {
    VoxelIndex forth, back;
    auto cells = test::scattered({-5, 2, 9}, 8, 5);
    for (const Cell& cell : cells) forth.insert(pack(cell));
    std::reverse(cells.begin(), cells.end());
    for (const Cell& cell : cells) back.insert(pack(cell));
    const auto order = [&](const VoxelIndex& index) {
        VoxelNeighbors neighbors;
        neighbors.update(index);
        std::vector<VoxelKey> keys;
        neighbors.each_within(index, 3, *index.find(pack(cells.front())),
                              [&](std::uint32_t v, int) { keys.push_back(index.key(v)); });
        return keys;
    };
    EXPECT_GT(order(forth).size(), 10U);
    EXPECT_EQ(order(forth), order(back));
}

TEST(VoxelNeighbors, EachAroundIsABlockAndItsMargin) {
    VoxelIndex index;
    for (const Cell& cell : test::scattered({-9, -9, -9}, 18, 6)) index.insert(pack(cell));
    VoxelNeighbors neighbors;
    neighbors.update(index);
    for (std::uint32_t block = 0; block < index.blocks(); ++block) {
        const Cell low = index.corner(block).array() - 2, high = index.corner(block).array() + 5;
        std::vector<std::uint32_t> expected, found;
        for (std::uint32_t v = 0; v < index.size(); ++v) {
            const Cell cell = unpack(index.key(v));
            if ((cell.array() >= low.array() && cell.array() <= high.array()).all()) {
                expected.push_back(v);
            }
        }
        neighbors.each_around(index, 2, block, [&](std::uint32_t v, const Cell& cell) {
            EXPECT_EQ(pack(index.corner(block) + cell), index.key(v));
            found.push_back(v);
        });
        std::sort(found.begin(), found.end());
        ASSERT_EQ(found, expected) << block;
    }
}

}  // namespace voxel_neighbors_test
}  // namespace dynamic_filter
