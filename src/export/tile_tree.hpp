// SPDX-License-Identifier: MIT
/// The quadtree above the tiles of a map.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/voxel_map/map_index.hpp"

namespace dynamic_filter::app {

/// A square with tiles in it. One with a single square in it is left out.
struct TreeNode {
    std::string name;                ///< of a tile; "root" if no square of the tree holds all tiles
    int level = 0;                   ///< as that of a tile
    const MapTile* tile = nullptr;   ///< of a leaf
    std::vector<TreeNode> children;  ///< none: it is a leaf
};

/// Throws InputError if the map has no tiles. The tree refers to the tiles of the index.
TreeNode tree_of(const MapIndex& index, const std::filesystem::path& folder);

}  // namespace dynamic_filter::app
