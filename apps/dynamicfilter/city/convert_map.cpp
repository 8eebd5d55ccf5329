// SPDX-License-Identifier: MIT
#include "city/convert_map.hpp"

#include <fmt/format.h>

#include "city/autoware_tiles.hpp"
#include "city/las_tiles.hpp"
#include "city/map_index.hpp"
#include "city/tileset.hpp"
#include "dynamic_filter/error.hpp"
#include "output_folder.hpp"

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
