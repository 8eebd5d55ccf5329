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

TEST(TileMap, LaterDrivesAddToWhatEarlierOnesSaw) {
    Sightings earlier(2), whole(40);
    for (Sightings* s : {&earlier, &whole}) {
        s->add({0, 0}, {5, 2});
        s->add({1, 9}, {5});
    }
    Archive writer;
    earlier.archive(writer);
    const std::vector<std::byte> bytes = writer.take();
    Archive reader(bytes);
    Sightings later(1);
    later.archive(reader);
    later.widen(40);
    for (Sightings* s : {&later, &whole}) s->add({39, 9}, {5, 7});
    for (const std::uint32_t v : {2U, 5U, 6U, 7U}) {
        EXPECT_EQ(later.scans(v), whole.scans(v)) << v;
        for (std::size_t word = 0; word < 2; ++word) {
            EXPECT_EQ(later.drives(v, word), whole.drives(v, word)) << v;
        }
    }
    EXPECT_EQ(later.voxels(), whole.voxels());
}

TEST(TileMap, RecordsOfFewerDrivesGetZerosForTheOthers) {
    Sightings few(3), many(40);
    few.add({2, 0}, {0, 1});
    io::Cloud from = empty_tile_map(few.words()), map = empty_tile_map(many.words());
    for (const std::uint32_t v : {0U, 1U, 2U}) {
        append(from, {.center = {1.0 + v, 0.0, 0.0}, .probability = 0.5F, .voxel = v}, few);
    }
    append(map, from, 1, 3);
    ASSERT_EQ(map.size(), 2U);
    EXPECT_EQ(io::values(map, *map.find("x")), (std::vector{2.0, 3.0}));
    EXPECT_EQ(io::values(map, *map.find("sessions")), (std::vector{4.0, 0.0}));
    EXPECT_EQ(map.data[35], std::byte{0});
    for (std::size_t at = 36; at < 40; ++at) EXPECT_EQ(map.data[at], std::byte{0});
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
