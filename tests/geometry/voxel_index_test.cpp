// SPDX-License-Identifier: MIT
#include "dynamic_filter/geometry/voxel_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "support/random.hpp"

namespace dynamic_filter {
namespace {

TEST(VoxelIndex, NumbersVoxelsInTheOrderTheyAreMet) {
    test::Random random(4);
    VoxelIndex index;
    std::vector<VoxelKey> met;
    for (int i = 0; i < 5000; ++i) {
        const VoxelKey key =
            pack(Cell(static_cast<int>(random.below(10)), -3, static_cast<int>(random.below(50))));
        const auto known = std::find(met.begin(), met.end(), key);
        EXPECT_EQ(index.find(key).has_value(), known != met.end());
        const auto expected = static_cast<std::uint32_t>(known - met.begin());
        if (known == met.end()) met.push_back(key);
        ASSERT_EQ(index.insert(key), expected);
        ASSERT_EQ(index.find(key), expected);
        ASSERT_EQ(index.key(expected), key);
        ASSERT_EQ(index.size(), met.size());
    }
}

/// Cells of a cube around `corner`, a third of them.
std::vector<Cell> scattered(const Cell& corner, int width, std::uint64_t seed) {
    test::Random random(seed);
    std::vector<Cell> cells;
    for (int i = 0; i < width * width * width / 3; ++i) {
        const auto step = [&] {
            return static_cast<int>(random.below(static_cast<std::uint32_t>(width)));
        };
        const Cell cell = corner + Cell(step(), step(), step());
        if (fits(cell)) cells.push_back(cell);
    }
    return cells;
}

TEST(VoxelIndex, EachWithinIsTheCubeAroundACell) {
    const Cell last = Cell::Constant(kCellLimit - 1), first = Cell::Constant(-kCellLimit);
    for (const Cell& corner : {Cell(-7, -6, -5), Cell(100, -3, 8), Cell(last.array() - 6), first}) {
        VoxelIndex index;
        const auto cells = scattered(corner, 12, 3);
        for (const Cell& cell : cells) index.insert(pack(cell));
        for (std::size_t i = 0; i < cells.size(); i += 5) {
            for (const int reach : {0, 1, 2, 4}) {
                std::map<std::uint32_t, int> expected, found;
                for (std::uint32_t v = 0; v < index.size(); ++v) {
                    const int distance = (unpack(index.key(v)) - cells[i]).cwiseAbs().maxCoeff();
                    if (distance <= reach) expected[v] = distance;
                }
                index.each_within(reach, pack(cells[i]), [&](std::uint32_t v, int distance) {
                    EXPECT_TRUE(found.try_emplace(v, distance).second) << "twice";
                });
                ASSERT_EQ(found, expected) << cells[i].transpose() << ", reach " << reach;
            }
        }
    }
}

TEST(VoxelIndex, EachWithinGoesByPlaceNotById) {
    VoxelIndex forth, back;
    auto cells = scattered({-5, 2, 9}, 8, 5);
    for (const Cell& cell : cells) forth.insert(pack(cell));
    std::reverse(cells.begin(), cells.end());
    for (const Cell& cell : cells) back.insert(pack(cell));
    const auto order = [&](const VoxelIndex& index) {
        std::vector<VoxelKey> keys;
        index.each_within(3, pack(cells.front()),
                          [&](std::uint32_t v, int) { keys.push_back(index.key(v)); });
        return keys;
    };
    EXPECT_GT(order(forth).size(), 10U);
    EXPECT_EQ(order(forth), order(back));
}

TEST(VoxelFinder, FindsWhatTheIndexFinds) {
    VoxelIndex index;
    for (const Cell& cell : scattered({-9, -9, -9}, 14, 1)) index.insert(pack(cell));
    VoxelFinder find(index);
    for (const Cell& cell : scattered({-11, -11, -11}, 18, 2)) {
        ASSERT_EQ(find(pack(cell)), index.find(pack(cell)).value_or(kNoVoxel));
    }
    EXPECT_EQ(VoxelFinder(VoxelIndex())(pack({0, 0, 0})), kNoVoxel);
}

}  // namespace
}  // namespace dynamic_filter
