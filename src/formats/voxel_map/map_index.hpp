// SPDX-License-Identifier: MIT
/// map/index.json: what the map of many drives consists of.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dynamic_filter::app {

/// Along the side of a tile of level 0; each level doubles it.
inline constexpr int kTileVoxels = 128;
inline constexpr const char* kMapFolder = "map";  ///< of the output of a run over many drives
inline constexpr const char* kWholeTile = "all";  ///< name of the only tile, without bounds
inline constexpr int kMapVersion = 1;             ///< of the index; others are refused

/// A recording that the map was made of.
struct MapDrive {
    std::string name;         ///< of its folder below drives/
    std::uint64_t scans = 0;  ///< that were used
    bool operator==(const MapDrive&) const = default;
};

/// A square of the ground, with all voxels above and below it.
struct MapTile {
    std::string name;                               ///< "LEVEL_X_Y", or "all"
    int level = 0;                                  ///< its side is side_of(voxel_size, level)
    std::int64_t x = 0, y = 0;                      ///< it covers [x, x+1) * side, [y, y+1) * side
    Eigen::Vector3d min = Eigen::Vector3d::Zero();  ///< [m] of its voxels, in the world frame
    Eigen::Vector3d max = Eigen::Vector3d::Zero();  ///< [m]
    std::uint64_t voxels = 0;                       ///< in its file
    std::uint64_t scans = 0;                        ///< that reached it
    std::string file;                               ///< beside the index
    bool is_whole = false;                          ///< "all": the only tile, without bounds
    bool operator==(const MapTile&) const = default;
};

struct MapIndex {
    int version = kMapVersion;
    double voxel_size = 0.2;  ///< [m]
    std::vector<MapDrive> drives;
    std::vector<MapTile> tiles;  ///< none of them lies within another
    bool operator==(const MapIndex&) const = default;
};

/// Side of the tiles of a level [m].
double side_of(double voxel_size, int level);

/// A square of the ground [m], in the world frame.
struct TileSquare {
    double west = 0.0, south = 0.0, side = 0.0;
};

/// The smallest square that holds the voxels of a tile: large tiles are often filled in part.
TileSquare filled_square(const MapIndex& index, const MapTile& tile);

/// The square that a tile covers; filled_square() if it is the only tile.
TileSquare square_of(const MapIndex& index, const MapTile& tile);

std::string tile_name(int level, std::int64_t x, std::int64_t y);

/// Whether this is the output folder of a run over many drives, its map folder, or map/index.json.
bool is_tiled_map(const std::filesystem::path& path);

/// The map folder of whatever is_tiled_map() accepts.
std::filesystem::path map_folder_of(const std::filesystem::path& path);

/// Reads FOLDER/index.json. Throws InputError if it is missing, damaged, contradicts itself or is
/// of another version.
MapIndex read_map_index(const std::filesystem::path& folder);

/// The text of index.json: the same bytes for the same index.
std::string to_json(const MapIndex& index);

/// Writes FOLDER/index.json atomically. Throws OutputError.
void write_map_index(const std::filesystem::path& folder, const MapIndex& index);

}  // namespace dynamic_filter::app
