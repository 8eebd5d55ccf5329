// SPDX-License-Identifier: MIT
#include "run/tile_map.hpp"

#include <gtest/gtest.h>

#include "geometry/voxel.hpp"

namespace dynamic_filter::app {
namespace tile_map_test {

TEST(TileMap, ScansAndDrivesAreCountedOncePerVoxel) {
    Sightings sightings(40);
    EXPECT_EQ(sightings.words(), 2U);
    sightings.add({0, 0}, {5, 5, kNoVoxel, 2, 5});
    sightings.add({0, 1}, {5});
    sightings.add({33, 1}, {5, 7});  // the same number of scan, of another drive
    EXPECT_EQ(sightings.scans(5), 3U);
    EXPECT_EQ(sightings.scans(2), 1U);
    EXPECT_EQ(sightings.scans(3), 0U);
    EXPECT_EQ(sightings.scans(1000), 0U);
    EXPECT_EQ(sightings.drives(5, 0), 1U);
    EXPECT_EQ(sightings.drives(5, 1), 2U);
    EXPECT_EQ(sightings.drives(7, 0), 0U);
    EXPECT_EQ(sightings.drives(7, 1), 2U);
    EXPECT_EQ(sightings.voxels(), 3U);
}

TEST(TileMap, TheRecordHoldsAllOfIt) {
    Sightings sightings(3);
    sightings.add({2, 0}, {0});
    io::Cloud map = empty_tile_map(sightings.words());
    append(map, {.center = {1e6 + 0.1, -2.5, 3.0}, .probability = 0.75F, .voxel = 0}, sightings);
    ASSERT_EQ(map.size(), 1U);
    EXPECT_EQ(io::values(map, *map.find("x")).front(), 1e6 + 0.1);
    EXPECT_EQ(io::values(map, *map.find("z")).front(), 3.0);
    EXPECT_EQ(io::values(map, *map.find("probability")).front(), 0.75);
    EXPECT_EQ(io::values(map, *map.find("scans")).front(), 1.0);
    EXPECT_EQ(io::values(map, *map.find("sessions")).front(), 4.0);
}

}  // namespace tile_map_test
}  // namespace dynamic_filter::app
