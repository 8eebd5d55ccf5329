// SPDX-License-Identifier: MIT
#include "formats/voxel_map/tile_points.hpp"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "dynamic_filter/error.hpp"
#include "support/sample_map.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace tile_points_test {

TEST(TilePoints, AreThoseOfTheFile) {
    const test::TemporaryFolder folder;
    for (const std::size_t drives : {3U, 40U}) {
        const MapIndex index = write_sample_map(folder.path(), drives);
        const MapTile& tile = index.tiles[5];
        const TilePoints points = read_tile(folder / "map", index, tile);
        const std::vector<SampleVoxel> voxels = sample_voxels(tile, drives, 0.8);
        ASSERT_EQ(points.size(), voxels.size());
        EXPECT_EQ(points.words, drives == 3 ? 1U : 2U);
        for (std::size_t i = 0; i < voxels.size(); ++i) {
            EXPECT_EQ(points.positions[i], voxels[i].position);
            EXPECT_EQ(points.probability[i], voxels[i].probability);
            EXPECT_EQ(points.scans[i], voxels[i].scans);
            for (std::size_t d = 0; d < drives; ++d)
                EXPECT_EQ(points.saw(d, i), (voxels[i].drives[d / 32] >> d % 32 & 1U) == 1U);
        }
    }
}

TEST(TilePoints, FilesThatDoNotFitTheIndexAreRefused) {
    const test::TemporaryFolder folder;
    MapIndex index = write_sample_map(folder.path());
    const auto expect_refused = [&](const MapTile& tile, const std::string& part) {
        try {
            read_tile(folder / "map", index, tile);
            ADD_FAILURE() << part;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(tile.file), std::string::npos);
        }
    };
    MapTile tile = index.tiles[0];
    tile.voxels += 1;
    expect_refused(tile, "and the index says");
    tile = index.tiles[0];
    tile.x += 1;
    expect_refused(tile, "lies outside of tile");
    tile = index.tiles[0];
    tile.file = "missing.pcd";
    expect_refused(tile, "missing.pcd");
    index.drives.resize(33);
    expect_refused(index.tiles[0], "field 'sessions'");
}

TEST(TilePoints, ATileWithoutVoxelsNeedsNoFile) {
    MapIndex index;
    index.tiles.emplace_back();
    EXPECT_EQ(read_tile("/nowhere", index, index.tiles[0]).size(), 0U);
}

TEST(TilePoints, ThinningKeepsOnePerCube) {
    const test::TemporaryFolder folder;
    const MapIndex index = write_sample_map(folder.path());
    const TilePoints points = read_tile(folder / "map", index, index.tiles[0]);
    const double spacing = 1.6;
    using Cube = std::tuple<double, double, double>;
    const auto cubes = [&](const TilePoints& of) {
        std::multiset<Cube> found;
        for (const Eigen::Vector3d& p : of.positions) {
            const Eigen::Array3d cube = (p.array() / spacing).floor();
            found.emplace(cube.x(), cube.y(), cube.z());
        }
        return found;
    };
    const TilePoints few = thinned(points, spacing);
    const auto before = cubes(points), after = cubes(few);
    EXPECT_EQ(std::set(before.begin(), before.end()), std::set(after.begin(), after.end()));
    EXPECT_EQ(std::set(after.begin(), after.end()).size(), after.size());
    EXPECT_LT(few.size(), points.size() / 2);
    EXPECT_EQ(thinned(points, kSampleVoxel).size(), points.size())
        << "a voxel is a cube of its own";
    EXPECT_EQ(few.drives.size(), few.size());
}

}  // namespace tile_points_test
}  // namespace dynamic_filter::app
