// SPDX-License-Identifier: MIT
#include "geometry/voxel_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

#include "support/cells.hpp"

namespace dynamic_filter {
namespace voxel_index_test {

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

std::vector<VoxelKey> packed(const std::vector<Cell>& cells) {
    std::vector<VoxelKey> keys;
    for (const Cell& cell : cells) keys.push_back(pack(cell));
    return keys;
}

TEST(VoxelIndex, ManyAreInsertedAndFoundAsOneByOne) {
    VoxelIndex one_by_one, together;
    auto keys = packed(test::scattered({-9, -9, -9}, 14, 1));
    keys.insert(keys.end(), keys.begin(), keys.begin() + 100);  // again
    std::vector<std::uint32_t> expected, ids(keys.size());
    for (const VoxelKey key : keys) expected.push_back(one_by_one.insert(key));
    together.insert(keys, ids);
    EXPECT_EQ(ids, expected);
    EXPECT_EQ(together.size(), one_by_one.size());
    EXPECT_EQ(together.blocks(), one_by_one.blocks());

    auto asked = packed(test::scattered({-11, -11, -11}, 18, 2));
    asked.push_back(~VoxelKey{0});  // kNoKey
    std::vector<std::uint32_t> found(asked.size());
    together.find(asked, found);
    for (std::size_t i = 0; i < asked.size(); ++i) {
        ASSERT_EQ(found[i], one_by_one.find(asked[i]).value_or(kNoVoxel));
    }
    VoxelIndex().find(asked, found);
    EXPECT_TRUE(std::all_of(found.begin(), found.end(), [](auto id) { return id == kNoVoxel; }));
}

TEST(VoxelIndex, KeysAreOfThePointsThatHaveOne) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Points points = {
        {0.1F, 0.1F, 0.1F}, {nan, 0.0F, 0.0F}, {-0.1F, 0.0F, 0.7F}, {1e9F, 0, 0}};
    const KeyedPoints keyed = keys_of(points, 2.0F);
    EXPECT_EQ(keyed.points, (std::vector<std::uint32_t>{0, 2}));
    EXPECT_EQ(keyed.keys, (std::vector<VoxelKey>{pack({0, 0, 0}), pack({-1, 0, 1})}));
}

TEST(BlockTable, FindsWhatWasInsertedAndNothingElse) {
    BlockTable table;
    test::Random random(7);
    std::map<VoxelKey, std::uint32_t> expected;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const VoxelKey corner = random.below(9000);  // zero, too
        const auto next = static_cast<std::uint32_t>(expected.size());
        const auto [it, fresh] = expected.try_emplace(corner, next);
        ASSERT_EQ(table.insert(corner, next), it->second);
    }
    for (VoxelKey corner = 0; corner < 12000; ++corner) {
        const auto it = expected.find(corner);
        ASSERT_EQ(table.find(corner), it == expected.end() ? kNoVoxel : it->second);
    }
}

}  // namespace voxel_index_test
}  // namespace dynamic_filter
