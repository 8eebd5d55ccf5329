// SPDX-License-Identifier: MIT
#include "export/las_tiles.hpp"

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "export/outputs.hpp"
#include "formats/voxel_map/tile_points.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

std::string write_las_tiles(const MapIndex& index, const fs::path& folder, const fs::path& output,
                            const std::optional<Georeference>& georeference) {
    if (index.tiles.empty()) throw InputError(folder / "index.json", "", "lists no tiles");
    fs::create_directories(output / "las");
    MapIndex written = index;
    std::string loss;
    for (MapTile& tile : written.tiles) {
        read_tile(folder, index, tile);  // says what is wrong with a file, before it is copied
        io::Cloud cloud = io::read_pcd(folder / tile.file);
        if (georeference) cloud = georeference->cloud(cloud);
        loss = io::write_las(output / "las" / (tile.name + ".las"), cloud).loss;
        tile.file = "las/" + tile.name + ".las";
    }
    // The squares of the index are those of the world's frame.
    if (!georeference) io::write_file(output / "index.json", to_json(written));
    return loss;
}

const FolderFiles& las_files() {
    static const FolderFiles files{.files = {"index.json"}, .folders = {{"las", ".las"}}};
    return files;
}

WrittenMap las_of_map(const MapIndex& index, const fs::path& map, const ConvertOptions& o,
                      const fs::path& output) {
    std::optional<Georeference> georeference;
    if (!o.crs.empty()) georeference.emplace(o.crs, o.origin);
    std::string loss = write_las_tiles(index, map, output, georeference);
    return {.files = index.tiles.size(), .note = std::move(loss)};
}

}  // namespace dynamic_filter::app
