// SPDX-License-Identifier: MIT
#include "export/tile_tree.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "dynamic_filter/error.hpp"
#include "support/sample_map.hpp"

namespace dynamic_filter::app {
namespace tile_tree_test {

MapIndex index_of(const std::vector<MapTile>& tiles) { return {kMapVersion, 0.2, {}, tiles}; }

MapTile tile(int level, std::int64_t x, std::int64_t y) {
    MapTile result;
    result.name = tile_name(level, x, y);
    result.level = level;
    result.x = x;
    result.y = y;
    return result;
}

void visit(const TreeNode& node, const std::function<void(const TreeNode&)>& act) {
    act(node);
    for (const TreeNode& child : node.children) visit(child, act);
}

TEST(TileTree, EveryTileIsALeafOnce) {
    const MapIndex index = index_of(sample_squares(3));
    std::multiset<std::string> leaves, names;
    visit(tree_of(index, ""), [&](const TreeNode& node) {
        names.insert(node.name);
        EXPECT_EQ(node.tile != nullptr, node.children.empty()) << node.name;
        EXPECT_NE(node.children.size(), 1U) << node.name << " holds nothing of its own";
        EXPECT_LE(node.children.size(), 4U);
        if (node.tile != nullptr) leaves.insert(node.tile->name);
        for (const TreeNode& child : node.children) EXPECT_LT(child.level, node.level);
    });
    EXPECT_EQ(leaves.size(), index.tiles.size());
    EXPECT_EQ(std::set(names.begin(), names.end()).size(), names.size());
}

TEST(TileTree, ChildrenLieWithinTheirSquare) {
    const MapIndex index = index_of(sample_squares(3));
    visit(tree_of(index, ""), [&](const TreeNode& node) {
        if (node.name == "root") return;
        for (const TreeNode& child : node.children) {
            visit(child, [&](const TreeNode& below) {
                if (below.tile == nullptr) return;
                const int up = node.level - below.level;
                EXPECT_EQ(tile_name(node.level, below.tile->x >> up, below.tile->y >> up),
                          node.name);
            });
        }
    });
}

TEST(TileTree, ASingleTileIsTheWholeTree) {
    const MapIndex index = index_of({tile(2, -7, 5)});
    const TreeNode tree = tree_of(index, "");
    EXPECT_EQ(tree.name, "2_-7_5");
    EXPECT_EQ(tree.tile, &index.tiles[0]);
    EXPECT_TRUE(tree.children.empty());
}

TEST(TileTree, TilesOnBothSidesOfTheOriginHaveARoot) {
    const TreeNode tree = tree_of(index_of({tile(0, -1, 0), tile(0, 0, 0)}), "");
    EXPECT_EQ(tree.name, "root");
    EXPECT_EQ(tree.children.size(), 2U);
    EXPECT_EQ(tree_of(index_of({tile(0, 2, 0), tile(0, 3, 1)}), "").name, "1_1_0");
    EXPECT_EQ(tree_of(index_of({tile(0, -500, 0), tile(0, 700, 0)}), "").children.size(), 2U);
}

TEST(TileTree, AMapWithoutTilesIsRefused) {
    EXPECT_THROW(tree_of(MapIndex{}, "out/map"), InputError);
}

}  // namespace tile_tree_test
}  // namespace dynamic_filter::app
