// SPDX-License-Identifier: MIT
#include "run/tiles.hpp"

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace dynamic_filter::app {
namespace tiles_test {

std::map<PlaneCell, std::size_t> street(int length, std::size_t each) {
    std::map<PlaneCell, std::size_t> voxels;
    for (int x = -length; x < length; ++x) voxels[{x, -1}] = voxels[{x, 0}] = each;
    return voxels;
}

TEST(Tiles, CellsAreRoundedDown) {
    EXPECT_EQ(cell_at({0.0, -0.1, 5.0}, 12.8), (PlaneCell{0, -1}));
    EXPECT_EQ(cell_at({12.9, -12.9, 5.0}, 12.8), (PlaneCell{1, -2}));
    EXPECT_EQ(tile_at({-1, 3}, 0), (Tile{.level = 0, .x = -1, .y = 1}));
    EXPECT_EQ(tile_at({-5, 3}, 1), (Tile{.level = 1, .x = -2, .y = 0}));
}

TEST(Tiles, OneTileIsEnoughForWhatFits) {
    const std::vector<Tile> tiles = tiles_of(street(10, 5), 200);
    ASSERT_EQ(tiles.size(), 1U);
    EXPECT_TRUE(tiles.front().is_whole);
    EXPECT_EQ(name_of(tiles.front()), "all");
}

TEST(Tiles, TilesHoldEveryCellOnceAndNoMoreThanAllowed) {
    const auto voxels = street(200, 7);
    const std::vector<Tile> tiles = tiles_of(voxels, 100);
    const TileLookup lookup(tiles);
    std::map<std::size_t, std::size_t> sums;
    for (const auto& [cell, count] : voxels) {
        const auto tile = lookup.find(cell);
        ASSERT_TRUE(tile);
        EXPECT_EQ(tile_at(cell, tiles[*tile].level), tiles[*tile]);
        sums[*tile] += count;
        std::size_t holders = 0;
        for (const Tile& other : tiles) holders += tile_at(cell, other.level) == other ? 1 : 0;
        EXPECT_EQ(holders, 1U);
    }
    EXPECT_EQ(sums.size(), tiles.size());  // none is empty
    for (const auto& [tile, sum] : sums) EXPECT_LE(sum, 100U);
    EXPECT_FALSE(lookup.find({1000, 1000}));
}

TEST(Tiles, TheSmallestTilesAreNotCutHoweverMuchTheyHold) {
    for (const Tile& tile : tiles_of(street(4, 1000), 10)) EXPECT_EQ(tile.level, 0);
}

TEST(Tiles, ARegionIsTheTileAndItsHalo) {
    const Region region = region_of({.level = 1, .x = -1, .y = 2}, 0.2, 3.0);
    const double side = 4 * 12.8;
    EXPECT_NEAR(region.origin.x(), -side, 1e-9);
    EXPECT_NEAR(region.origin.y(), 2 * side, 1e-9);
    EXPECT_EQ(region.origin.z(), 3.0);
    EXPECT_NEAR(region.bounds.min().x(), -3.2, 1e-9);
    EXPECT_NEAR(region.bounds.max().y(), side + 3.2, 1e-9);
}

}  // namespace tiles_test
}  // namespace dynamic_filter::app
