// SPDX-License-Identifier: MIT
/// A map as LAS files, one for each tile.
#pragma once

#include <filesystem>
#include <optional>

#include "export/georeference.hpp"
#include "formats/voxel_map/map_index.hpp"

namespace dynamic_filter::app {

/// Writes las/NAME.las for each tile, and index.json as that of the map with these files. The
/// fields probability, scans and sessions are Extra Bytes. With a georeference, the points are in
/// its coordinate system, and there is no index.json. One tile is in memory at a time. Returns what
/// LAS could not hold, as a sentence.
std::string write_las_tiles(const MapIndex& index, const std::filesystem::path& folder,
                            const std::filesystem::path& output,
                            const std::optional<Georeference>& georeference = {});

}  // namespace dynamic_filter::app
