// SPDX-License-Identifier: MIT
/// The static voxels of one tile of a map.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "formats/voxel_map/map_index.hpp"

namespace dynamic_filter::app {

/// Voxels as columns; all but `drives` have one entry each. In files their field is `sessions`.
struct TilePoints {
    std::vector<Eigen::Vector3d> positions;  ///< [m] centres, in the world frame
    std::vector<float> probability;          ///< of being occupied
    std::vector<std::uint32_t> scans;        ///< with a point in it
    std::vector<std::uint32_t> drives;       ///< `words` per voxel: bits of the drives that saw it
    std::size_t words = 1;                   ///< per voxel

    [[nodiscard]] std::size_t size() const { return positions.size(); }
    /// Whether drive `drive` saw voxel i occupied.
    [[nodiscard]] bool saw(std::size_t drive, std::size_t i) const {
        return (drives[i * words + drive / 32] >> (drive % 32) & 1U) != 0;
    }
    /// Appends voxel i of another tile with as many words.
    void append(const TilePoints& other, std::size_t i);
};

/// Words per voxel for so many drives.
std::size_t drive_words(std::size_t drives);

/// Reads the file of a tile. Throws InputError if a field is missing or of another type, or if the
/// file does not fit the index.
TilePoints read_tile(const std::filesystem::path& folder, const MapIndex& index,
                     const MapTile& tile);

/// One voxel for each cube of edge `spacing` [m], the first in the order given. Cubes are aligned
/// with the world's origin, so that tiles can be thinned one by one.
TilePoints thinned(const TilePoints& points, double spacing);

}  // namespace dynamic_filter::app
