// SPDX-License-Identifier: MIT
#include "formats/voxel_map/map_index.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "dynamic_filter/error.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace map_index_test {

MapTile tile(int level, std::int64_t x, std::int64_t y) {
    const std::string name = tile_name(level, x, y);
    return {name, level, x, y, {0.1, -0.3, 1e-7}, {25.5, 0.1, 4.0}, 12, 34, name + ".pcd"};
}

MapIndex small_index() {
    return {
        kMapVersion, 0.2, {{"north \"loop\"", 5000}, {"b", 0}}, {tile(0, -1, 0), tile(1, 0, 3)}};
}

/// What is said of an index that is not as it should be.
std::string complaint(const std::string& text) {
    const test::TemporaryFolder folder;
    folder.put("index.json", text);
    try {
        read_map_index(folder.path());
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing";
}

/// The small index with one text in the place of another.
std::string with(const std::string& from, const std::string& to) {
    std::string text = to_json(small_index());
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

void expect_complaint(const std::string& text, const std::string& part) {
    const std::string said = complaint(text);
    EXPECT_NE(said.find(part), std::string::npos) << said;
    EXPECT_NE(said.find("index.json"), std::string::npos) << said;
}

TEST(MapIndex, ReadsWhatItWrites) {
    const test::TemporaryFolder folder;
    write_map_index(folder.path(), small_index());
    EXPECT_EQ(read_map_index(folder.path()), small_index());
    EXPECT_EQ(test::slurp(folder / "index.json"), to_json(small_index()));
    write_map_index(folder.path(), {});
    EXPECT_EQ(read_map_index(folder.path()), MapIndex{});
}

TEST(MapIndex, IsJsonOfTheDocumentedForm) {
    const auto json = nlohmann::json::parse(to_json(small_index()));
    EXPECT_EQ(json["version"], 1);
    EXPECT_EQ(json["drives"][0]["name"], "north \"loop\"");
    EXPECT_EQ(json["tiles"][0]["name"], "0_-1_0");
    EXPECT_EQ(json["tiles"][0]["min"], nlohmann::json({0.1, -0.3, 1e-7}));
    EXPECT_EQ(json["tiles"][1]["file"], "1_0_3.pcd");
}

TEST(MapIndex, OtherVersionsAreRefused) {
    expect_complaint(with("\"version\": 1", "\"version\": 2"), "this program reads version 1");
}

TEST(MapIndex, SaysWhereItIsDamaged) {
    expect_complaint("{\"version\": 1", "is not JSON");
    expect_complaint("[]", "is not JSON");
    expect_complaint("{}", "'version' is missing");
    expect_complaint(with("\"voxel_size\": 0.2", "\"voxel_size\": 0"), "'voxel_size'");
    expect_complaint(with("\"scans\":5000", "\"scans\":-1"), "(drive 0)");
    expect_complaint(with("\"voxels\":12", "\"voxels\":\"12\""), "(tile 0)");
    expect_complaint(with("\"min\":[0.1,", "\"min\":["), "'min' is not x y z");
    expect_complaint(with("\"y\":3", "\"y\":4"), "the name '1_0_3' is not that of");
    expect_complaint(with("\"file\":\"0_", "\"file\":\"../0_"), "does not lie beside the index");
    EXPECT_THROW(read_map_index("/nowhere"), InputError);
}

TEST(MapIndex, TilesDoNotOverlap) {
    MapIndex index = small_index();
    index.tiles.push_back(tile(0, -1, 0));
    expect_complaint(to_json(index), "tile 0_-1_0 is listed twice");
    index.tiles.back() = tile(3, -1, 0);
    expect_complaint(to_json(index), "tile 0_-1_0 lies within tile 3_-1_0");
}

/// A map that needs no tiles has a single one without bounds.
TEST(MapIndex, TheOnlyTileCoversItsVoxels) {
    MapTile all = tile(0, 0, 0);
    all.name = "all";
    all.file = "all.pcd";
    all.min = {-3.0, 10.0, 0.0};
    all.max = {200.0, 30.0, 5.0};
    MapIndex index{kMapVersion, 0.2, {{"a", 1}}, {all}};
    const test::TemporaryFolder folder;
    write_map_index(folder.path(), index);
    index.tiles[0].is_whole = true;
    EXPECT_EQ(read_map_index(folder.path()), index);
    const TileSquare square = square_of(index, index.tiles[0]);
    EXPECT_NEAR(square.west, -3.1, 1e-12);
    EXPECT_NEAR(square.south, 9.9, 1e-12);
    EXPECT_NEAR(square.side, 203.2, 1e-12);
    index.tiles.push_back(tile(1, 0, 3));
    expect_complaint(to_json(index), "but there are others");
}

TEST(MapIndex, TheSideOfATileIsAPowerOfTwoOfVoxels) {
    EXPECT_DOUBLE_EQ(side_of(0.2, 0), 25.6);
    EXPECT_DOUBLE_EQ(side_of(0.1, 3), 102.4);
    MapIndex index = small_index();
    index.voxel_size = 0.5;
    const TileSquare square = square_of(index, tile(1, -2, 3));
    EXPECT_EQ(square.west, -256.0);
    EXPECT_EQ(square.south, 384.0);
    EXPECT_EQ(square.side, 128.0);
}

TEST(MapIndex, IsFoundFromEachOfItsFolders) {
    const test::TemporaryFolder folder;
    EXPECT_FALSE(is_tiled_map(folder.path()));
    folder.put("out/map/index.json", to_json(small_index()));
    folder.put("las/index.json", to_json(small_index()));
    for (const char* name : {"out", "out/map", "out/map/", "out/map/index.json"}) {
        EXPECT_TRUE(is_tiled_map(folder / name)) << name;
        EXPECT_EQ(read_map_index(map_folder_of(folder / name)), small_index()) << name;
    }
    EXPECT_FALSE(is_tiled_map(folder / "las")) << "LAS tiles have an index, but are no map";
    EXPECT_FALSE(is_tiled_map(folder / "nothing"));
}

}  // namespace map_index_test
}  // namespace dynamic_filter::app
