// SPDX-License-Identifier: MIT
#include "export/convert_map.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/exit_code.hpp"
#include "base/output_folder.hpp"
#include "dynamic_filter/error.hpp"
#include "export/autoware_tiles.hpp"
#include "export/las_tiles.hpp"
#include "export/tileset.hpp"
#include "formats/voxel_map/map_index.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

/// A float has 24 bits: beyond this its steps are coarser than a centimetre.
constexpr double kFarForFloats = 131072.0;  // [m]

std::string note_on_floats(const MapIndex& index) {
    for (const MapTile& tile : index.tiles) {
        if (tile.min.cwiseAbs().maxCoeff() < kFarForFloats &&
            tile.max.cwiseAbs().maxCoeff() < kFarForFloats)
            continue;
        return "coordinates are rounded to float32, which is coarser than 1 cm there; Autoware "
               "expects a frame whose origin is near";
    }
    return "";
}

/// The origin is where the world's frame begins, so coordinates of a map projection lie far off.
std::string note_on_origin(const MapIndex& index) {
    constexpr double kFar = 100'000.0;  // [m] there the tangent plane is 800 m above the ground
    double least = std::numeric_limits<double>::infinity();
    for (const MapTile& tile : index.tiles) {
        const TileSquare square = square_of(index, tile);
        least = std::min(least, std::hypot(square.west, square.south));
    }
    if (least < kFar || index.tiles.empty()) return "";
    return fmt::format(
        "the map lies {:.0f} km from the origin of its frame, for which --origin gives latitude "
        "and longitude; coordinates such as UTM have to be made relative to a place nearby "
        "first, in the poses of the recordings",
        1e-3 * least);
}

Contents contents_of(const std::string& to) {
    if (to == "3dtiles") return Contents::tiles_3d;
    return to == "las" ? Contents::las_tiles : Contents::tiles;
}

void check_options(const ConvertOptions& o) {
    if (o.to.empty() || o.to == "kitti" || o.to == "benchmark") {
        throw ConfigError(o.data.data.string() +
                          ": is the map of several drives; choose what to make of it with --to "
                          "3dtiles, --to las or --to autoware");
    }
    if (o.labels) {
        throw ConfigError(
            "--labels is for a recording; the map of several drives holds static voxels only");
    }
    if (!o.origin.empty() && o.to != "3dtiles")
        throw ConfigError("--origin is for --to 3dtiles only");
}

}  // namespace

int convert_map(const ConvertOptions& o) {
    check_options(o);
    std::optional<GeoOrigin> origin;
    if (!o.origin.empty()) origin = geo_origin(o.origin);
    const fs::path folder = map_folder_of(o.data.data);
    const MapIndex index = read_map_index(folder);
    OutputFolder output(o.output, contents_of(o.to), replaced_if(o.overwrite));
    std::size_t files = index.tiles.size();
    std::string note;
    if (o.to == "3dtiles") {
        files = write_tileset(index, folder, origin, output.path());
        if (origin) note = note_on_origin(index);
    } else if (o.to == "las") {
        note = write_las_tiles(index, folder, output.path());
    } else {
        files = write_autoware_tiles(index, folder, output.path());
        note = note_on_floats(index);
    }
    output.commit();
    if (!note.empty()) fmt::print(stderr, "note: {}\n", note);
    fmt::print("written  {} ({} tiles as {} files)\n", output.name().string(), index.tiles.size(),
               files);
    return kDone;
}

}  // namespace dynamic_filter::app
