// SPDX-License-Identifier: MIT
#include "run/tiles.hpp"

#include <cmath>

#include "geometry/voxel.hpp"

namespace dynamic_filter::app {

namespace {

using Voxels = std::map<PlaneCell, std::size_t>;

std::size_t sum_of(const Voxels& voxels) {
    std::size_t sum = 0;
    for (const auto& [cell, count] : voxels) sum += count;
    return sum;
}

void cut_tile(const Tile& tile, const Voxels& voxels, std::size_t most, std::vector<Tile>& tiles) {
    if (tile.level == 0 || sum_of(voxels) <= most) {
        tiles.push_back(tile);
        return;
    }
    std::map<Tile, Voxels> quarters;
    for (const auto& [cell, count] : voxels) quarters[tile_at(cell, tile.level - 1)][cell] = count;
    for (const auto& [quarter, inside] : quarters) cut_tile(quarter, inside, most, tiles);
}

}  // namespace

std::size_t PlaneCellHash::operator()(const PlaneCell& cell) const {
    return VoxelHash{}(std::uint64_t{static_cast<std::uint32_t>(cell.x)} << 32 |
                       static_cast<std::uint32_t>(cell.y));
}

PlaneCell cell_at(const Eigen::Vector3d& world, double edge) {
    return {static_cast<std::int32_t>(std::floor(world.x() / edge)),
            static_cast<std::int32_t>(std::floor(world.y() / edge))};
}

std::string name_of(const Tile& tile) {
    return tile.is_whole ? kWholeTile : tile_name(tile.level, tile.x, tile.y);
}

Tile tile_at(const PlaneCell& cell, int level) {
    // Shifts to the right round down, also for negative numbers.
    return {.level = level, .x = cell.x >> (level + 1), .y = cell.y >> (level + 1)};
}

Region region_of(const Tile& tile, double voxel_size, double height) {
    const double side = side_of(voxel_size, tile.level), halo = kHaloVoxels * voxel_size;
    const Eigen::Vector2d corner = side * Eigen::Vector2d(tile.x, tile.y);
    return {.origin = {corner.x(), corner.y(), height},
            .bounds = {Eigen::Vector2d::Constant(-halo), Eigen::Vector2d::Constant(side + halo)}};
}

std::vector<Tile> tiles_of(const Voxels& voxels, std::size_t most) {
    if (sum_of(voxels) <= most) return {{.is_whole = true}};
    std::map<Tile, Voxels> tops;
    for (const auto& [cell, count] : voxels) tops[tile_at(cell, kTopLevel)][cell] = count;
    std::vector<Tile> tiles;
    for (const auto& [top, inside] : tops) cut_tile(top, inside, most, tiles);
    return tiles;
}

TileLookup::TileLookup(const std::vector<Tile>& tiles) : by_level_(kTopLevel + 1) {
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const Tile& tile = tiles[i];
        is_whole_ |= tile.is_whole;
        by_level_[static_cast<std::size_t>(tile.level)][{tile.x, tile.y}] = i;
    }
}

std::optional<std::size_t> TileLookup::find(const PlaneCell& cell) const {
    if (is_whole_) return 0;
    for (int level = 0; level <= kTopLevel; ++level) {
        const Tile tile = tile_at(cell, level);
        const auto& tiles = by_level_[static_cast<std::size_t>(level)];
        const auto found = tiles.find({tile.x, tile.y});
        if (found != tiles.end()) return found->second;
    }
    return std::nullopt;
}

}  // namespace dynamic_filter::app
