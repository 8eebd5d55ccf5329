// SPDX-License-Identifier: MIT
/// A map as 3D Tiles 1.1.
#pragma once

#include <filesystem>
#include <optional>

#include "export/georeference.hpp"
#include "formats/voxel_map/map_index.hpp"

namespace dynamic_filter::app {

/// Writes tileset.json and tiles/NAME.glb into `output`. A square above tiles holds one voxel of
/// each cube whose edge is 1/128 of its side. A tile of more than 300,000 voxels is such a square,
/// too, with its quarters below. In memory are one tile and the thinned squares beside the way down
/// to it. Returns the number of .glb files.
std::size_t write_tileset(const MapIndex& index, const std::filesystem::path& folder,
                          const std::optional<GeoOrigin>& origin,
                          const std::filesystem::path& output);

}  // namespace dynamic_filter::app
