// SPDX-License-Identifier: MIT
#include "page/map_page.hpp"

#include <algorithm>
#include <cmath>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/voxel_map/heights.hpp"
#include "page/page.hpp"
#include "page/tile_page.hpp"
#include "page/tile_picture.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

using nlohmann::ordered_json;

/// Room on the overview and on the pages of tiles; with many tiles each has less of it.
constexpr double kPictureBytes = 12e6, kPagePoints = 20e6;
constexpr std::size_t kPathPoints = 200'000;

int most_picture_edge(std::size_t tiles) {
    const double edge =
        std::sqrt(kPictureBytes / static_cast<double>(std::max<std::size_t>(tiles, 1)));
    return static_cast<int>(std::clamp(edge, 16.0, 256.0));
}

std::size_t most_page_points(std::size_t tiles) {
    const double points = kPagePoints / static_cast<double>(std::max<std::size_t>(tiles, 1));
    return static_cast<std::size_t>(std::clamp(points, 20e3, 150e3));
}

/// All that the overview says of a tile; its picture goes to the others.
ordered_json entry_of(const MapIndex& index, const MapTile& tile, const TilePoints& points,
                      const HeightRange& heights, std::vector<std::uint8_t>& pictures) {
    const TileSquare square = square_of(index, tile), filled = filled_square(index, tile);
    const int edge = picture_edge(filled, index.voxel_size, most_picture_edge(index.tiles.size()));
    const std::vector<std::uint8_t> picture = picture_from_above(points, filled, edge, heights);
    pictures.insert(pictures.end(), picture.begin(), picture.end());
    ordered_json drives = ordered_json::array();
    const std::vector<std::uint64_t> voxels = voxels_by_drive(points, index.drives.size());
    for (std::size_t d = 0; d < voxels.size(); ++d)
        if (voxels[d] > 0) drives.push_back(d);
    return {{"name", tile.name},
            {"west", square.west},
            {"south", square.south},
            {"side", square.side},
            {"voxels", tile.voxels},
            {"scans", tile.scans},
            {"picture", {filled.west, filled.south, filled.side}},
            {"edge", edge},
            {"drives", drives},
            {"bottom", tile.min.z()},
            {"top", tile.max.z()}};
}

/// Every so many positions, and the last, relative to `origin`.
void add_paths(const std::vector<DrivePath>& paths, const Eigen::Vector3d& origin, PageRun& run) {
    std::size_t all = 0;
    for (const DrivePath& path : paths) all += path.positions.size();
    const std::size_t stride = all / kPathPoints + 1;
    std::vector<float> positions;
    std::vector<std::uint32_t> begin{0};
    ordered_json names = ordered_json::array();
    for (const DrivePath& path : paths) {
        for (std::size_t i = 0; i < path.positions.size(); ++i) {
            if (i % stride != 0 && i + 1 != path.positions.size()) continue;
            const Eigen::Vector3f at = (path.positions[i] - origin).cast<float>();
            positions.insert(positions.end(), {at.x(), at.y()});
        }
        names.push_back(path.name);
        begin.push_back(static_cast<std::uint32_t>(positions.size() / 2));
    }
    run.info["tracks"] = names;
    run.arrays.push_back(page_array("track-position", 2, positions));
    run.arrays.push_back(page_array("track-begin", 1, begin));
}

/// Whole metres, so that floats hold what is relative to it.
Eigen::Vector3d origin_of_map(const MapIndex& index) {
    if (index.tiles.empty()) return Eigen::Vector3d::Zero();
    const TileSquare first = square_of(index, index.tiles.front());
    return {std::floor(first.west), std::floor(first.south), 0.0};
}

PageRun overview_of(const MapIndex& index, const ordered_json& metrics,
                    const ordered_json& timing) {
    PageRun run;
    run.info["kind"] = "city";
    run.info["name"] = "Map of several drives";
    run.info["command"] = "run";
    run.info["version"] = DYNAMIC_FILTER_VERSION;
    run.info["voxel_size"] = index.voxel_size;
    run.info["drives"] = ordered_json::array();
    for (const MapDrive& drive : index.drives)
        run.info["drives"].push_back({{"name", drive.name}, {"scans", drive.scans}});
    run.info["tiles"] = ordered_json::array();
    run.info["scores"] = metrics;
    run.info["timing"] = timing;
    return run;
}

}  // namespace

void write_map_page(const fs::path& out, const ordered_json& metrics, const ordered_json& timing,
                    const std::vector<DrivePath>& paths) {
    const MapIndex index = read_map_index(out / kMapFolder);
    const fs::path pages = out / "report";
    const SharedPage shared = shared_page();
    std::error_code error;
    fs::create_directories(pages, error);
    if (error) throw OutputError(pages, error.message());
    io::write_file(pages / "viewer.js", shared.script);
    io::write_file(pages / "viewer.css", shared.style);
    PageRun overview = overview_of(index, metrics, timing);
    const HeightRange heights = usual_heights(index);
    const std::size_t most = most_page_points(index.tiles.size());
    std::vector<std::uint8_t> pictures;
    for (const MapTile& tile : index.tiles) {
        const TilePoints points = read_tile(out / kMapFolder, index, tile);
        overview.info["tiles"].push_back(entry_of(index, tile, points, heights, pictures));
        io::write_file(pages / (tile.name + ".html"),
                       shared.with(embedded(view_of_tile(index, tile, points, most), 0)));
    }
    const Eigen::Vector3d origin = origin_of_map(index);
    overview.info["origin"] = {origin.x(), origin.y(), origin.z()};
    overview.info["heights"] = {heights.low, heights.high};
    overview.arrays.push_back(page_array("tile-picture", 1, pictures));
    add_paths(paths, origin, overview);
    const std::string run = embedded(overview, 0);
    io::write_file(out / "report.html", page_with({&run, 1}));
}

}  // namespace dynamic_filter::app
