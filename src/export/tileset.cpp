// SPDX-License-Identifier: MIT
#include "export/tileset.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "export/glb.hpp"
#include "export/outputs.hpp"
#include "export/tile_tree.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

using nlohmann::ordered_json;

constexpr double kCubesPerSide = 128.0;
/// A viewer goes to the children when the error is 16 pixels, as is the custom: then a square is
/// 256 pixels wide, and its cubes are two.
constexpr double kErrorsPerSide = 16.0;

/// Voxels in one file: what a viewer loads in one piece.
constexpr std::size_t kMostTogether = 300'000;

/// The values that all nodes share while they are written.
struct Writer {
    const MapIndex& index;
    const fs::path& folder;
    fs::path tiles;
    HeightRange heights;
    std::size_t written = 0;
};

/// A node that is done: its entry in tileset.json, and what of it the node above shows.
struct Done {
    ordered_json json;
    Eigen::AlignedBox3d box;
    TilePoints above;
};

ordered_json bounding_volume(const Eigen::AlignedBox3d& box) {
    const Eigen::Vector3d c = box.center(), half = box.sizes() / 2.0;
    return {{"box", {c.x(), c.y(), c.z(), half.x(), 0, 0, 0, half.y(), 0, 0, 0, half.z()}}};
}

void write_content(Writer& writer, const std::string& name, const TilePoints& points,
                   const Eigen::AlignedBox3d& box, ordered_json& json) {
    const Eigen::Vector3d origin = box.center().array().round();
    io::write_file(writer.tiles / (name + ".glb"), glb_of(points, origin, writer.heights));
    json["content"]["uri"] = "tiles/" + name + ".glb";
    ++writer.written;
}

double side_at(const Writer& writer, int level) { return side_of(writer.index.voxel_size, level); }

double spacing_of(const Writer& writer, int level) {
    return side_at(writer, level) / kCubesPerSide;
}

/// A square whose content is what is left of its parts.
Done write_above(Writer& writer, const TreeNode& node, std::vector<Done> below,
                 double spacing_above) {
    TilePoints points;
    points.words = drive_words(writer.index.drives.size());
    Done done;
    ordered_json children = ordered_json::array();
    for (Done& child : below) {
        for (std::size_t i = 0; i < child.above.size(); ++i) points.append(child.above, i);
        done.box.extend(child.box);
        children.push_back(std::move(child.json));
    }
    done.json = {{"boundingVolume", bounding_volume(done.box)},
                 {"geometricError", side_at(writer, node.level) / kErrorsPerSide}};
    write_content(writer, node.name, points, done.box, done.json);
    done.json["children"] = std::move(children);
    done.above = thinned(points, spacing_above);
    return done;
}

Done write_whole(Writer& writer, const std::string& name, const TilePoints& points,
                 double spacing_above) {
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(writer.index.voxel_size / 2.0);
    Done done;
    for (const Eigen::Vector3d& position : points.positions) done.box.extend(position);
    done.box = {done.box.min() - half, done.box.max() + half};
    done.json = {{"boundingVolume", bounding_volume(done.box)}, {"geometricError", 0}};
    write_content(writer, name, points, done.box, done.json);
    done.above = thinned(points, spacing_above);
    return done;
}

/// A square of the quadtree, and the voxels in it.
struct TreeSquare {
    std::int64_t x = 0, y = 0;
    TilePoints points;
};

/// Groups the points by squares of this side. `parent`: the square that contains all of them.
/// Voxels on its border count as within, so that no two tiles write a file of the same name.
std::vector<TreeSquare> squares_of(const TilePoints& points, double side,
                                   const TreeSquare* parent) {
    std::map<std::pair<std::int64_t, std::int64_t>, TilePoints> squares;
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::int64_t x = std::llround(std::floor(points.positions[i].x() / side));
        std::int64_t y = std::llround(std::floor(points.positions[i].y() / side));
        if (parent != nullptr) {
            x = std::clamp(x, 2 * parent->x, 2 * parent->x + 1);
            y = std::clamp(y, 2 * parent->y, 2 * parent->y + 1);
        }
        TilePoints& square = squares[{y, x}];
        square.words = points.words;
        square.append(points, i);
    }
    std::vector<TreeSquare> result;
    for (auto& [at, square] : squares) result.push_back({at.second, at.first, std::move(square)});
    return result;
}

/// A tile, or a part of one that has more voxels than a viewer takes at once.
Done write_square(Writer& writer, int level, const TreeSquare& square, double spacing_above) {
    const std::string name = tile_name(level, square.x, square.y);
    if (level == 0 || square.points.size() <= kMostTogether)
        return write_whole(writer, name, square.points, spacing_above);
    std::vector<Done> parts;
    const double half = side_at(writer, level - 1);
    for (const TreeSquare& quarter : squares_of(square.points, half, &square))
        parts.push_back(write_square(writer, level - 1, quarter, spacing_of(writer, level)));
    if (parts.size() == 1) {
        parts.front().above = thinned(parts.front().above, spacing_above);
        return std::move(parts.front());
    }
    return write_above(writer, {name, level, nullptr, {}}, std::move(parts), spacing_above);
}

/// The only tile has no square of its own: those of the first level at which they are few.
Done write_everything(Writer& writer, const MapTile& tile, const TreeNode& node) {
    const TilePoints points = read_tile(writer.folder, writer.index, tile);
    const double extent = square_of(writer.index, tile).side;
    int level = 0;
    while (side_at(writer, level) < extent) ++level;
    std::vector<Done> parts;
    for (const TreeSquare& square : squares_of(points, side_at(writer, level), nullptr))
        parts.push_back(write_square(writer, level, square, spacing_of(writer, level + 1)));
    if (parts.size() == 1) return std::move(parts.front());
    return write_above(writer, {node.name, level + 1, nullptr, {}}, std::move(parts),
                       spacing_of(writer, level + 2));
}

Done write_node(Writer& writer, const TreeNode& node, double spacing_above) {
    if (const MapTile* tile = node.tile) {
        if (tile->is_whole) return write_everything(writer, *tile, node);
        return write_square(writer, tile->level,
                            {tile->x, tile->y, read_tile(writer.folder, writer.index, *tile)},
                            spacing_above);
    }
    std::vector<Done> below;
    for (const TreeNode& child : node.children)
        below.push_back(write_node(writer, child, spacing_of(writer, node.level)));
    return write_above(writer, node, std::move(below), spacing_above);
}

ordered_json column_major(const Eigen::Matrix4d& matrix) {
    ordered_json list = ordered_json::array();
    for (int i = 0; i < 16; ++i) list.push_back(matrix.data()[i]);
    return list;
}

}  // namespace

std::size_t write_tileset(const MapIndex& index, const fs::path& folder,
                          const std::optional<GeoOrigin>& origin, const fs::path& output) {
    MapIndex filled = index;  // a box around no voxels is none
    std::erase_if(filled.tiles, [](const MapTile& tile) { return tile.voxels == 0; });
    const TreeNode tree = tree_of(filled, folder);
    Writer writer{index, folder, output / "tiles", usual_heights(filled)};
    fs::create_directories(writer.tiles);
    Done root = write_node(writer, tree, spacing_of(writer, tree.level + 1));
    root.json["refine"] = "REPLACE";
    if (origin) root.json["transform"] = column_major(earth_from_world(*origin));
    const ordered_json tileset = {
        {"asset", {{"version", "1.1"}, {"generator", "DynamicFilter " DYNAMIC_FILTER_VERSION}}},
        {"geometricError", root.json["geometricError"].get<double>() +
                               side_at(writer, tree.level + 1) / kErrorsPerSide},
        {"root", std::move(root.json)}};
    io::write_file(output / "tileset.json", tileset.dump() + "\n");
    return writer.written;
}

namespace {

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

}  // namespace

const FolderFiles& tileset_files() {
    static const FolderFiles files{.files = {"tileset.json"}, .folders = {{"tiles", ".glb"}}};
    return files;
}

WrittenMap tileset_of_map(const MapIndex& index, const fs::path& map, const ConvertOptions& o,
                          const fs::path& output) {
    std::optional<GeoOrigin> origin;
    if (!o.origin.empty()) origin = geo_origin(o.origin);
    const std::size_t files = write_tileset(index, map, origin, output);
    return {.files = files, .note = origin ? note_on_origin(index) : ""};
}

}  // namespace dynamic_filter::app
