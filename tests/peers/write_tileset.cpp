// SPDX-License-Identifier: MIT
// Writes the map of a made-up city as 3D Tiles, and prints what is in it: a line per tile and
// field, as read_tileset.mjs prints them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "export/tileset.hpp"
#include "formats/voxel_map/tile_points.hpp"
#include "peers/sample.hpp"
#include "support/sample_map.hpp"

namespace dynamic_filter::app {
namespace {

/// [mm], as a reader has them from floats.
std::vector<double> millimetres(const TilePoints& points, int axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& p : points.positions)
        values.push_back(std::round(1000.0 * p[axis]));
    return values;
}

void print(const std::string& tile, const char* field, const std::vector<double>& values) {
    fmt::print("{} {} {} {:08x}\n", tile, field, values.size(), io::fnv1a(values));
}

void print_tile(const MapTile& tile, const TilePoints& points) {
    for (int axis = 0; axis < 3; ++axis)
        print(tile.name, std::array{"x", "y", "z"}[static_cast<std::size_t>(axis)],
              millimetres(points, axis));
    print(tile.name, "probability", {points.probability.begin(), points.probability.end()});
    print(tile.name, "scans", {points.scans.begin(), points.scans.end()});
    for (std::size_t word = 0; word < points.words; ++word) {
        std::vector<double> bytes;
        for (std::size_t i = 0; i < points.size(); ++i)
            for (unsigned shift = 0; shift < 32; shift += 8)
                bytes.push_back(points.drives[i * points.words + word] >> shift & 255U);
        print(tile.name, word == 0 ? "sessions_0" : "sessions_1", bytes);
    }
}

}  // namespace
}  // namespace dynamic_filter::app

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    using namespace dynamic_filter::app;
    const std::filesystem::path out = argv[1];
    MapIndex index = write_sample_map(out, 40);
    write_tileset(index, out / "map", geo_origin("48.1374,11.5755,520"), out);
    std::sort(index.tiles.begin(), index.tiles.end(),
              [](const MapTile& a, const MapTile& b) { return a.name < b.name; });
    for (const MapTile& tile : index.tiles) print_tile(tile, read_tile(out / "map", index, tile));
    return 0;
}
