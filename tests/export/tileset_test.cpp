// SPDX-License-Identifier: MIT
#include "export/tileset.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "dynamic_filter/error.hpp"
#include "formats/voxel_map/tile_points.hpp"
#include "support/sample_map.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace tileset_test {

using nlohmann::json;

/// A .glb taken apart.
struct Glb {
    json header;
    std::string data;

    explicit Glb(const std::filesystem::path& file) {
        const std::string bytes = test::slurp(file);
        const auto number = [&](std::size_t at) {
            std::uint32_t value = 0;
            std::memcpy(&value, bytes.data() + at, 4);
            return value;
        };
        EXPECT_EQ(bytes.substr(0, 4), "glTF");
        EXPECT_EQ(number(8), bytes.size());
        header = json::parse(bytes.substr(20, number(12)));
        data = bytes.substr(28 + number(12));
    }
    template <class T>
    [[nodiscard]] std::vector<T> values(const std::string& attribute) const {
        const auto& primitive = header["meshes"][0]["primitives"][0];
        const auto& accessor = header["accessors"][primitive["attributes"][attribute].get<int>()];
        const auto& view = header["bufferViews"][accessor["bufferView"].get<int>()];
        std::vector<T> result(view["byteLength"].get<std::size_t>() / sizeof(T));
        std::memcpy(result.data(), data.data() + view["byteOffset"].get<std::size_t>(),
                    result.size() * sizeof(T));
        return result;
    }
    /// In the world: by the node, and from y up to z up as viewers do.
    [[nodiscard]] std::vector<Eigen::Vector3d> positions() const {
        Eigen::Matrix4d node;
        for (int i = 0; i < 16; ++i) node.data()[i] = header["nodes"][0]["matrix"][i];
        const std::vector<float> floats = values<float>("POSITION");
        std::vector<Eigen::Vector3d> result;
        for (std::size_t i = 0; i < floats.size(); i += 3) {
            const Eigen::Vector4d up =
                node * Eigen::Vector4d(floats[i], floats[i + 1], floats[i + 2], 1.0);
            result.emplace_back(up.x(), -up.z(), up.y());
        }
        return result;
    }
};

void visit(const json& tile, const std::function<void(const json&)>& act) {
    act(tile);
    if (!tile.contains("children")) return;
    for (const json& child : tile["children"]) visit(child, act);
}

Eigen::AlignedBox3d box_of(const json& tile) {
    const auto& b = tile["boundingVolume"]["box"];
    const Eigen::Vector3d center(b[0], b[1], b[2]), half(b[3], b[7], b[11]);
    return {center - half, center + half};
}

class Tileset : public testing::Test {
protected:
    json write(std::size_t drives, int level, double step) {
        index_ = write_sample_map(folder_.path(), drives, level, step);
        written_ = write_tileset(index_, folder_ / "map", std::nullopt, folder_ / "out");
        return json::parse(test::slurp(folder_ / "out/tileset.json"));
    }
    [[nodiscard]] Glb content(const json& tile) const {
        return Glb(folder_ / ("out/" + tile["content"]["uri"].get<std::string>()));
    }
    test::TemporaryFolder folder_;
    MapIndex index_;
    std::size_t written_ = 0;
};

TEST_F(Tileset, LeavesHoldEveryVoxelWithAllItSays) {
    const json tileset = write(40, 1, 0.8);
    EXPECT_EQ(tileset["asset"]["version"], "1.1");
    std::map<std::string, Glb> leaves;
    visit(tileset["root"], [&](const json& tile) {
        if (tile.contains("children")) return;
        EXPECT_EQ(tile["geometricError"], 0);
        leaves.emplace(tile["content"]["uri"], content(tile));
    });
    ASSERT_EQ(leaves.size(), index_.tiles.size());
    for (const MapTile& tile : index_.tiles) {
        const Glb& leaf = leaves.at("tiles/" + tile.name + ".glb");
        const TilePoints points = read_tile(folder_ / "map", index_, tile);
        const std::vector<Eigen::Vector3d> positions = leaf.positions();
        const auto scans = leaf.values<float>("_SCANS");
        const auto words = leaf.values<std::uint32_t>("_SESSIONS_1");
        EXPECT_EQ(leaf.values<float>("_PROBABILITY"), points.probability);
        ASSERT_EQ(positions.size(), points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_LT((positions[i] - points.positions[i]).norm(), 1e-5);
            EXPECT_EQ(scans[i], static_cast<float>(points.scans[i]));
            EXPECT_EQ(words[i], points.drives[2 * i + 1]);
        }
    }
}

TEST_F(Tileset, BoxesHoldPointsAndChildrenAndErrorsFall) {
    const json tileset = write(3, 1, 0.8);
    std::size_t contents = 0;
    EXPECT_GE(tileset["geometricError"], tileset["root"]["geometricError"]);
    visit(tileset["root"], [&](const json& tile) {
        const Eigen::Vector3d rounding = Eigen::Vector3d::Constant(1e-9);
        const Eigen::AlignedBox3d exact = box_of(tile);
        const Eigen::AlignedBox3d box(exact.min() - rounding, exact.max() + rounding);
        ++contents;
        for (const Eigen::Vector3d& p : content(tile).positions()) EXPECT_TRUE(box.contains(p));
        if (!tile.contains("children")) return;
        for (const json& child : tile["children"]) {
            EXPECT_TRUE(box.contains(box_of(child)));
            EXPECT_LT(child["geometricError"], tile["geometricError"]);
        }
    });
    EXPECT_EQ(contents, written_);
    EXPECT_EQ(tileset["root"]["refine"], "REPLACE");
    EXPECT_FALSE(tileset["root"].contains("transform"));
}

TEST_F(Tileset, SquaresAboveAreThinnedEvenly) {
    const json tileset = write(3, 1, 0.8);
    std::size_t all = 0;
    for (const MapTile& tile : index_.tiles) all += tile.voxels;
    const auto root = content(tileset["root"]).positions();
    EXPECT_LT(root.size(), all / 2);
    for (const MapTile& tile : index_.tiles) {  // each tile is seen from above
        const bool seen = std::any_of(root.begin(), root.end(), [&](const Eigen::Vector3d& p) {
            return Eigen::AlignedBox3d(tile.min, tile.max).contains(p);
        });
        EXPECT_TRUE(seen) << tile.name;
    }
}

TEST_F(Tileset, ATileOfManyVoxelsIsCutIntoQuarters) {
    const json tileset = write(1, 3, 0.4);
    std::size_t most = 0, all = 0;
    visit(tileset["root"], [&](const json& tile) {
        const std::size_t n = content(tile).positions().size();
        most = std::max(most, n);
        if (!tile.contains("children")) all += n;
    });
    EXPECT_LE(most, 300'000U);
    std::size_t voxels = 0;
    for (const MapTile& tile : index_.tiles) voxels += tile.voxels;
    EXPECT_EQ(all, voxels) << "every voxel is in one leaf";
    EXPECT_GT(written_, 2 * index_.tiles.size());
}

/// As if the map of one tile had been written without tiles, around the origin.
TEST_F(Tileset, TheOnlyTileIsCutIntoSquaresOfTheTree) {
    MapIndex index = write_sample_map(folder_.path(), 3, 2, 0.8);
    MapTile all = index.tiles.front();
    const std::vector<std::string> around{"2_-1_-1", "2_-1_0", "2_0_-1", "2_0_0"};
    io::Cloud cloud;
    for (const std::string& name : around) {
        const io::Cloud part = io::read_cloud(folder_ / ("map/" + name + ".pcd"));
        if (cloud.fields.empty())
            cloud = part;
        else
            cloud.data.insert(cloud.data.end(), part.data.begin(), part.data.end());
    }
    io::write_pcd(folder_ / "map/all.pcd", cloud);
    all.name = "all";
    all.file = "all.pcd";
    all.is_whole = true;
    all.level = 0;
    all.x = all.y = 0;
    all.voxels = cloud.size();
    all.min = {-102.3, -102.3, -3.0};
    all.max = {102.3, 102.3, 30.0};
    index.tiles = {all};
    write_tileset(index, folder_ / "map", std::nullopt, folder_ / "out");
    const json tileset = json::parse(test::slurp(folder_ / "out/tileset.json"));
    std::size_t points = 0;
    visit(tileset["root"], [&](const json& tile) {
        if (!tile.contains("children")) points += content(tile).positions().size();
    });
    EXPECT_EQ(points, all.voxels);
}

TEST_F(Tileset, TilesWithoutVoxelsAreLeftOut) {
    MapIndex index = write_sample_map(folder_.path());
    MapTile none;
    none.level = 0;
    none.x = none.y = 999;
    none.name = tile_name(0, 999, 999);
    none.file = none.name + ".pcd";
    index.tiles.push_back(none);
    write_tileset(index, folder_ / "map", std::nullopt, folder_ / "out");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/tiles/0_999_999.glb"));
}

}  // namespace tileset_test
}  // namespace dynamic_filter::app
