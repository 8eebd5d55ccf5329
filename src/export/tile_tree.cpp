// SPDX-License-Identifier: MIT
#include "export/tile_tree.hpp"

#include <algorithm>
#include <map>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {

namespace {

using TileList = std::vector<const MapTile*>;
using TilesBySquare = std::map<std::pair<std::int64_t, std::int64_t>, TileList>;

/// Groups the tiles by the square of a level in which they lie.
TilesBySquare squares_of(const TileList& tiles, int level) {
    TilesBySquare squares;
    for (const MapTile* tile : tiles) {
        const int up = level - tile->level;
        squares[{tile->y >> up, tile->x >> up}].push_back(tile);
    }
    return squares;
}

TreeNode node_of(const TileList& tiles, int level);

std::vector<TreeNode> nodes_of(const TilesBySquare& squares, int level) {
    std::vector<TreeNode> nodes;
    for (const auto& [square, tiles] : squares) nodes.push_back(node_of(tiles, level));
    return nodes;
}

TreeNode node_of(const TileList& tiles, int level) {
    const MapTile& first = *tiles.front();
    if (tiles.size() == 1) return {first.name, first.level, &first, {}};
    std::vector<TreeNode> children = nodes_of(squares_of(tiles, level - 1), level - 1);
    if (children.size() == 1) return std::move(children.front());
    const int up = level - first.level;
    return {tile_name(level, first.x >> up, first.y >> up), level, nullptr, std::move(children)};
}

/// Allows two squares side by side in x and in y, because squares left and right of the origin have
/// no common parent: x = -1 and x = 0 are in different squares of every level.
bool are_close(const TilesBySquare& squares) {
    const auto y = std::minmax_element(
        squares.begin(), squares.end(),
        [](const auto& a, const auto& b) { return a.first.first < b.first.first; });
    const auto x = std::minmax_element(
        squares.begin(), squares.end(),
        [](const auto& a, const auto& b) { return a.first.second < b.first.second; });
    return y.second->first.first - y.first->first.first <= 1 &&
           x.second->first.second - x.first->first.second <= 1;
}

}  // namespace

TreeNode tree_of(const MapIndex& index, const std::filesystem::path& folder) {
    if (index.tiles.empty()) throw InputError(folder / "index.json", "", "lists no tiles");
    TileList tiles;
    int level = 0;
    for (const MapTile& tile : index.tiles) {
        tiles.push_back(&tile);
        level = std::max(level, tile.level);
    }
    while (!are_close(squares_of(tiles, level))) ++level;
    if (squares_of(tiles, level + 1).size() == 1) ++level;
    std::vector<TreeNode> tops = nodes_of(squares_of(tiles, level), level);
    if (tops.size() == 1) return std::move(tops.front());
    return {"root", level + 1, nullptr, std::move(tops)};
}

}  // namespace dynamic_filter::app
