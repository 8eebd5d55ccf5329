// SPDX-License-Identifier: MIT
#include "upkeep/unseen.hpp"

#include <tsl/robin_map.h>

#include <vector>

#include "base/little_endian.hpp"
#include "formats/voxel_map/tile_points.hpp"
#include "geometry/world_voxel.hpp"

namespace dynamic_filter::app {

namespace {

constexpr std::uint8_t kOld = 1, kNew = 2;

struct SeenAt {
    Eigen::Vector3d center;  // [m]
    std::uint8_t dates;
};

std::uint8_t dates_of(const TilePoints& points, std::size_t i, std::size_t drives,
                      std::size_t old_drives) {
    std::uint8_t dates = 0;
    for (std::size_t drive = 0; drive < drives; ++drive) {
        if (points.saw(drive, i)) dates |= drive < old_drives ? kOld : kNew;
    }
    return dates;
}

}  // namespace

SeenVoxels seen_voxels(const std::filesystem::path& map, std::size_t old_drives) {
    const MapIndex index = read_map_index(map);
    tsl::robin_map<WorldVoxel, SeenAt, NumbersHash> voxels;
    for (const MapTile& tile : index.tiles) {
        const TilePoints points = read_tile(map, index, tile);
        for (std::size_t i = 0; i < points.size(); ++i) {
            voxels.insert(
                {world_voxel(points.positions[i], index.voxel_size),
                 {points.positions[i], dates_of(points, i, index.drives.size(), old_drives)}});
        }
    }
    const auto dates_around = [&](const WorldVoxel& voxel) {
        std::uint8_t dates = 0;
        for (std::int64_t x = -1; x <= 1; ++x) {
            for (std::int64_t y = -1; y <= 1; ++y) {
                for (std::int64_t z = -1; z <= 1; ++z) {
                    const auto near = voxels.find({voxel[0] + x, voxel[1] + y, voxel[2] + z});
                    if (near != voxels.end()) dates |= near->second.dates;
                }
            }
        }
        return dates;
    };
    SeenVoxels seen;
    for (const char* axis : {"x", "y", "z"}) io::add_field(seen.unseen, axis, io::FieldType::f64);
    io::add_field(seen.unseen, "seen", io::FieldType::u8);
    for (const auto& [voxel, at] : voxels) {
        const std::uint8_t dates = at.dates == (kOld | kNew) ? at.dates : dates_around(voxel);
        ++(dates == kOld ? seen.old_only : dates == kNew ? seen.new_only : seen.at_both);
        if (dates == (kOld | kNew)) continue;
        for (const double coordinate : at.center) put(seen.unseen.data, coordinate);
        put(seen.unseen.data, dates);
    }
    return seen;
}

}  // namespace dynamic_filter::app
