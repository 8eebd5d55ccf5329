// SPDX-License-Identifier: MIT
#include "formats/voxel_map/heights.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::app {
namespace heights_test {

MapIndex index_of(std::size_t tiles, double low, double high) {
    MapIndex index;
    for (std::size_t i = 0; i < tiles; ++i) {
        MapTile tile;
        tile.voxels = 1;
        tile.min.z() = low;
        tile.max.z() = high;
        index.tiles.push_back(tile);
    }
    return index;
}

TEST(Heights, AreThoseOfMostTiles) {
    MapIndex index = index_of(100, -2.0, 20.0);
    index.tiles[7].min.z() = -500.0;
    index.tiles[8].max.z() = 900.0;
    EXPECT_EQ(usual_heights(index).low, -2.0);
    EXPECT_EQ(usual_heights(index).high, 20.0);
}

TEST(Heights, AreNeverAllTheSame) {
    EXPECT_EQ(usual_heights(index_of(1, 3.0, 3.0)).high, 4.0);
    EXPECT_LT(usual_heights({}).low, usual_heights({}).high);
}

TEST(Heights, TilesWithoutVoxelsDoNotCount) {
    MapIndex index = index_of(3, 5.0, 9.0);
    index.tiles[0].voxels = 0;
    index.tiles[0].min.z() = 0.0;
    EXPECT_EQ(usual_heights(index).low, 5.0);
}

}  // namespace heights_test
}  // namespace dynamic_filter::app
