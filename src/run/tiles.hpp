// SPDX-License-Identifier: MIT
/// The area of a map, cut into square tiles that are filtered one by one.
///
/// The plane is cut into cells of 64 voxels (12.8 m for voxels of 0.2 m). A tile of level 0 is two
/// cells wide, and each level doubles that. Cells and tiles are counted from the origin of the
/// world.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <tsl/robin_map.h>

#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/recording.hpp"
#include "formats/voxel_map/map_index.hpp"

namespace dynamic_filter::app {

/// Column and row of a cell of the plane.
struct PlaneCell {
    std::int32_t x = 0, y = 0;
    auto operator<=>(const PlaneCell&) const = default;
};

struct PlaneCellHash {
    std::size_t operator()(const PlaneCell& cell) const;
};

constexpr int kVoxelsPerCell = kTileVoxels / 2;
inline double cell_edge(double voxel_size) { return kVoxelsPerCell * voxel_size; }  ///< [m]

/// The cell of a place in the world. It must be finite and within 40,000 km.
PlaneCell cell_at(const Eigen::Vector3d& world, double edge);

/// False for coordinates that no place on Earth has; they belong to no cell.
inline bool has_cell(const Eigen::Vector3d& world) {
    constexpr double kFarthest = 1e8;  // [m]
    return world.cwiseAbs().maxCoeff() < kFarthest;
}

/// Calls use(i, world) for every point of the scan that was measured and has a cell, in order.
template <class Use>
void each_measured(const io::FullScan& scan, const Use& use) {
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
        if (!is_measured(scan.points[i])) continue;
        const Eigen::Vector3d world = scan.T_world_sensor * scan.points[i].cast<double>();
        if (has_cell(world)) use(i, world);
    }
}

struct Tile {
    int level = 0;
    std::int32_t x = 0, y = 0;  ///< in tiles of this level
    /// True: the only tile, without bounds. Level, x and y are 0 then.
    bool is_whole = false;
    auto operator<=>(const Tile&) const = default;
};

constexpr int kTopLevel = 6;  ///< of the largest tiles: 1.6 km for voxels of 0.2 m

std::string name_of(const Tile& tile);                 ///< "3_-1_0", or "all"
inline int cells_of(int level) { return 2 << level; }  ///< along an edge of a tile
Tile tile_at(const PlaneCell& cell, int level);

/// Width of the halo around a tile: a quarter of a cell. Votes need two voxels of it; the rest
/// shows enough of an object on the border to follow it.
constexpr int kHaloVoxels = 16;

/// The tile and its halo. `height` [m]: of the
/// origin of the filter's frame. The tile has bounds.
Region region_of(const Tile& tile, double voxel_size, double height);

/// Cuts an area into tiles: those of the top level are cut in four as long as they hold more than
/// `most` voxels. If all cells together do not hold more, one tile is enough. `voxels`: number of
/// voxels by cell. Tiles are in order; empty ones are left out.
std::vector<Tile> tiles_of(const std::map<PlaneCell, std::size_t>& voxels, std::size_t most);

/// Finds the tile of a cell.
class TileLookup {
public:
    explicit TileLookup(const std::vector<Tile>& tiles);
    /// Index in the tiles; empty: in none of them.
    [[nodiscard]] std::optional<std::size_t> find(const PlaneCell& cell) const;

private:
    std::vector<tsl::robin_map<PlaneCell, std::size_t, PlaneCellHash>> by_level_;
    bool is_whole_ = false;
};

}  // namespace dynamic_filter::app
