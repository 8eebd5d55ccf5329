// SPDX-License-Identifier: MIT
#include "dynamic_filter/geometry/voxel_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/cells.hpp"

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

TEST(VoxelIndex, GroupsNewVoxelsByBlockAndLeavesTheOldOnesAlone) {
    VoxelIndex index;
    const auto cells = test::scattered({-9, -9, -9}, 16, 7);
    std::vector<std::uint32_t> before;
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i == cells.size() / 3) first = static_cast<std::uint32_t>(index.size());
        before.push_back(index.insert(pack(cells[i])));
    }
    const std::size_t size = index.size(), blocks = index.blocks();
    const auto renumbered = index.group_by_block(first);
    ASSERT_EQ(renumbered.size(), size - first);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::uint32_t now = before[i] < first ? before[i] : renumbered[before[i] - first];
        EXPECT_EQ(index.find(pack(cells[i])), now);
        EXPECT_EQ(index.insert(pack(cells[i])), now);
        EXPECT_EQ(index.key(now), pack(cells[i]));
        const Cell corner = cells[i].unaryExpr([](int c) { return c >> 2 << 2; });
        EXPECT_EQ(index.corner(index.block_of_voxel(now)), corner);
    }
    std::size_t runs = 0;
    for (std::uint32_t v = first; v < size; ++v) {
        runs += v == first || index.block_of_voxel(v) != index.block_of_voxel(v - 1) ? 1 : 0;
    }
    EXPECT_LE(runs, blocks);
    EXPECT_TRUE(index.group_by_block(static_cast<std::uint32_t>(size)).empty());
}

TEST(VoxelFinder, FindsWhatTheIndexFinds) {
    VoxelIndex index;
    for (const Cell& cell : test::scattered({-9, -9, -9}, 14, 1)) index.insert(pack(cell));
    VoxelFinder find(index);
    for (const Cell& cell : test::scattered({-11, -11, -11}, 18, 2)) {
        ASSERT_EQ(find(pack(cell)), index.find(pack(cell)).value_or(kNoVoxel));
    }
    EXPECT_EQ(VoxelFinder(VoxelIndex())(pack({0, 0, 0})), kNoVoxel);
}

}  // namespace
}  // namespace dynamic_filter
