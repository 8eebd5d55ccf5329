// SPDX-License-Identifier: MIT
#include "export/autoware_tiles.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "dynamic_filter/writers.hpp"
#include "export/georeference.hpp"
#include "export/outputs.hpp"
#include "export/tile_tree.hpp"
#include "formats/voxel_map/tile_points.hpp"
#include "recording/world_records.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

/// As Autoware's launch files name a map by default, be it a file or a folder.
constexpr const char* kTileFolder = "pointcloud_map.pcd";

/// The squares that a tile lies in, whole or in part, or that its voxels are in.
std::vector<Corner> squares_of(const MapIndex& index, const MapTile& tile) {
    const TileSquare square = square_of(index, tile);
    const double slack = index.voxel_size;
    const std::int64_t east = autoware_corner(square.west + square.side + slack);
    const std::int64_t north = autoware_corner(square.south + square.side + slack);
    std::vector<Corner> squares;
    for (std::int64_t x = autoware_corner(square.west - slack); x <= east; x += kAutowareTile)
        for (std::int64_t y = autoware_corner(square.south - slack); y <= north; y += kAutowareTile)
            squares.emplace_back(x, y);
    return squares;
}

io::Cloud empty_square(std::size_t words) {
    io::Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, io::FieldType::f32);
    add_field(cloud, "probability", io::FieldType::f32);
    add_field(cloud, "scans", io::FieldType::u32);
    add_field(cloud, "sessions", io::FieldType::u32, static_cast<std::uint32_t>(words));
    return cloud;
}

void append(io::Cloud& cloud, const TilePoints& points, std::size_t i) {
    const std::size_t at = cloud.data.size();
    cloud.data.resize(at + cloud.point_bytes);
    std::byte* record = cloud.data.data() + at;
    const Eigen::Vector3f position = points.positions[i].cast<float>();
    std::memcpy(record, position.data(), 12);
    std::memcpy(record + 12, &points.probability[i], 4);
    std::memcpy(record + 16, &points.scans[i], 4);
    std::memcpy(record + 20, &points.drives[i * points.words], 4 * points.words);
}

/// Squares under way: what they hold, and how many tiles are still to come.
class OpenSquares {
public:
    OpenSquares(const MapIndex& index, fs::path folder)
        : index_(index), folder_(std::move(folder)), words_(drive_words(index.drives.size())) {
        for (const MapTile& tile : index.tiles)
            for (const Corner& corner : squares_of(index_, tile)) ++to_come_[corner];
    }

    void add(const TilePoints& points, const MapTile& tile) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Corner corner{autoware_corner(points.positions[i].x()),
                                autoware_corner(points.positions[i].y())};
            io::Cloud& cloud = open_.try_emplace(corner, empty_square(words_)).first->second;
            append(cloud, points, i);
        }
        for (const Corner& corner : squares_of(index_, tile)) {
            if (--to_come_[corner] == 0) write(corner);
        }
    }
    [[nodiscard]] std::vector<Corner> written() const { return {written_.begin(), written_.end()}; }

private:
    void write(const Corner& corner) {
        const auto it = open_.find(corner);
        if (it == open_.end()) return;  // nothing of any tile lies there
        io::write_pcd(folder_ / autoware_name(corner), it->second);
        open_.erase(it);
        written_.insert(corner);
    }

    const MapIndex& index_;
    fs::path folder_;
    std::size_t words_;
    std::map<Corner, std::size_t> to_come_;
    std::map<Corner, io::Cloud> open_;
    std::set<Corner> written_;
};

/// In the order of the quadtree, so that squares across borders are soon complete.
void add_tiles(const TreeNode& node, const MapIndex& index, const fs::path& folder,
               OpenSquares& squares) {
    if (node.tile != nullptr) squares.add(read_tile(folder, index, *node.tile), *node.tile);
    for (const TreeNode& child : node.children) add_tiles(child, index, folder, squares);
}

}  // namespace

std::int64_t autoware_corner(double value) {
    return kAutowareTile * static_cast<std::int64_t>(std::floor(value / kAutowareTile));
}

std::string autoware_name(const Corner& corner) {
    return fmt::format("{}_{}.pcd", corner.first, corner.second);
}

std::string autoware_metadata(const std::vector<Corner>& squares) {
    std::string text = fmt::format("x_resolution: {0}.0\ny_resolution: {0}.0\n", kAutowareTile);
    for (const Corner& corner : squares) {
        text += fmt::format("{}: [{}, {}]\n", autoware_name(corner), corner.first, corner.second);
    }
    return text;
}

std::string autoware_projector(const std::string& origin) {
    if (origin.empty()) return "projector_type: Local\n";
    const GeoOrigin at = geo_origin(origin);
    return fmt::format(
        "projector_type: LocalCartesian\nvertical_datum: WGS84\nmap_origin:\n"
        "  latitude: {}\n  longitude: {}\n  altitude: {}\n",
        at.latitude_deg, at.longitude_deg, at.height);
}

std::size_t write_autoware_tiles(const MapIndex& index, const fs::path& folder,
                                 const fs::path& output) {
    const TreeNode tree = tree_of(index, folder);
    fs::create_directories(output / kTileFolder);
    OpenSquares squares(index, output / kTileFolder);
    add_tiles(tree, index, folder, squares);
    io::write_file(output / "pointcloud_map_metadata.yaml", autoware_metadata(squares.written()));
    return squares.written().size();
}

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

}  // namespace

const FolderFiles& autoware_files() {
    static const FolderFiles files{
        .files = {"pointcloud_map_metadata.yaml", "map_projector_info.yaml"},
        .folders = {{kTileFolder, ".pcd"}, {"pointcloud_map", ".pcd"}}};  // the earlier name
    return files;
}

WrittenMap autoware_of_map(const MapIndex& index, const fs::path& map, const ConvertOptions& o,
                           const fs::path& output) {
    io::write_file(output / "map_projector_info.yaml", autoware_projector(o.origin));
    const std::size_t files = write_autoware_tiles(index, map, output);
    return {.files = files, .note = note_on_floats(index)};
}

WrittenMap autoware_of_cloud(const io::Cloud& cloud, const ConvertOptions& o,
                             const fs::path& output) {
    io::write_file(output / "map_projector_info.yaml", autoware_projector(o.origin));

    const auto x = io::values(cloud, *cloud.find("x")), y = io::values(cloud, *cloud.find("y"));
    std::map<Corner, io::Cloud> tiles;
    std::size_t nowhere = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        if (!std::isfinite(x[i]) || !std::isfinite(y[i])) {
            ++nowhere;
            continue;
        }
        io::Cloud& tile = tiles[{autoware_corner(x[i]), autoware_corner(y[i])}];
        tile.fields = cloud.fields;
        tile.point_bytes = cloud.point_bytes;
        append_record(tile.data, cloud.data, i, cloud.point_bytes);
    }
    const fs::path folder = output / kTileFolder;
    fs::create_directories(folder);
    std::vector<Corner> corners;
    for (const auto& [corner, tile] : tiles) {
        io::write_pcd(folder / autoware_name(corner), tile);
        corners.push_back(corner);
    }
    io::write_file(output / "pointcloud_map_metadata.yaml", autoware_metadata(corners));
    std::string note;
    if (nowhere > 0) note = fmt::format("left out: {} points that are not finite", nowhere);
    return {.files = corners.size(), .note = std::move(note)};
}

}  // namespace dynamic_filter::app
