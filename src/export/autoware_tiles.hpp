// SPDX-License-Identifier: MIT
/// Autoware's map tiles: squares of the ground, each a PCD, and where its lower corner is.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "formats/voxel_map/map_index.hpp"

namespace dynamic_filter::app {

inline constexpr int kAutowareTile = 20;  ///< [m]

/// The lower corner of a square [m].
using Corner = std::pair<std::int64_t, std::int64_t>;

/// The corner of the square that a coordinate lies in, along its axis [m].
std::int64_t autoware_corner(double value);

/// Name of a square's file.
std::string autoware_name(const Corner& corner);

/// The text of pointcloud_map_metadata.yaml.
std::string autoware_metadata(const std::vector<Corner>& squares);

/// The text of map_projector_info.yaml: where `origin`, LAT,LON[,HEIGHT], lies; local coordinates
/// if it is empty. Throws ConfigError.
std::string autoware_projector(const std::string& origin);

/// Cuts the tiles of a map into such squares: OUTPUT/pointcloud_map.pcd/*.pcd and the metadata.
/// Coordinates become float32. In memory are one tile and the squares that lie across the border of
/// what was read so far. Returns the number of squares.
std::size_t write_autoware_tiles(const MapIndex& index, const std::filesystem::path& folder,
                                 const std::filesystem::path& output);

}  // namespace dynamic_filter::app
