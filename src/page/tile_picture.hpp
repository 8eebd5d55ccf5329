// SPDX-License-Identifier: MIT
/// A tile from above, for the overview of a map.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/voxel_map/heights.hpp"
#include "formats/voxel_map/tile_points.hpp"

namespace dynamic_filter::app {

/// Pixels along each side: at most `most`, and no finer than the voxels.
int picture_edge(const TileSquare& square, double voxel_size, int most);

/// The highest voxel of each pixel: 1 to 255 from the bottom to the top of `heights`, 0 where there
/// is none. Row 0 is the north (greatest y); edge * edge pixels.
std::vector<std::uint8_t> picture_from_above(const TilePoints& points, const TileSquare& square,
                                             int edge, const HeightRange& heights);

}  // namespace dynamic_filter::app
