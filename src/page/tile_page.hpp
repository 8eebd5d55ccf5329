// SPDX-License-Identifier: MIT
/// The page of one tile of a map.
#pragma once

#include "formats/voxel_map/map_index.hpp"
#include "formats/voxel_map/tile_points.hpp"
#include "page/page.hpp"

namespace dynamic_filter::app {

/// Voxels of a tile that each drive saw, in the order of the index.
std::vector<std::uint64_t> voxels_by_drive(const TilePoints& points, std::size_t drives);

/// The tile as the viewer shows it, with links to the overview and to the tiles around it. At most
/// `most` voxels are shown.
PageRun view_of_tile(const MapIndex& index, const MapTile& tile, const TilePoints& points,
                     std::size_t most);

}  // namespace dynamic_filter::app
