// SPDX-License-Identifier: MIT
#include "formats/voxel_map/map_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "base/json_vector.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

using nlohmann::ordered_json;

constexpr const char* kIndex = "index.json";
constexpr int kMostLevel = 30;

/// A part of the file, and where it is, for messages.
struct IndexPlace {
    const fs::path& file;
    std::string where;

    [[noreturn]] void refuse(const std::string& what) const {
        throw InputError(
            file, where,
            what + "; copy the folder again from where the run wrote it, or run again");
    }
    [[nodiscard]] const ordered_json& at(const ordered_json& object, const char* name) const {
        if (!object.is_object() || !object.contains(name))
            refuse(fmt::format("'{}' is missing", name));
        return object[name];
    }
    [[nodiscard]] std::string text(const ordered_json& object, const char* name) const {
        const ordered_json& value = at(object, name);
        if (!value.is_string()) refuse(fmt::format("'{}' is not a text", name));
        return value.get<std::string>();
    }
    [[nodiscard]] std::int64_t whole(const ordered_json& object, const char* name,
                                     std::int64_t least, std::int64_t most) const {
        const ordered_json& value = at(object, name);
        const bool fits = value.is_number_integer() && value.get<std::int64_t>() >= least &&
                          value.get<std::int64_t>() <= most;
        if (!fits)
            refuse(fmt::format("'{}' is not a whole number from {} to {}", name, least, most));
        return value.get<std::int64_t>();
    }
    [[nodiscard]] std::uint64_t count(const ordered_json& object, const char* name) const {
        return static_cast<std::uint64_t>(
            whole(object, name, 0, std::numeric_limits<std::int64_t>::max()));
    }
    [[nodiscard]] Eigen::Vector3d vector(const ordered_json& object, const char* name) const {
        const ordered_json& value = at(object, name);
        Eigen::Vector3d result;
        if (!value.is_array() || value.size() != 3) refuse(fmt::format("'{}' is not x y z", name));
        for (int axis = 0; axis < 3; ++axis) {
            const ordered_json& number = value[static_cast<std::size_t>(axis)];
            if (!number.is_number()) refuse(fmt::format("'{}' is not x y z", name));
            result[axis] = number.get<double>();
        }
        return result;
    }
    [[nodiscard]] const ordered_json& list(const ordered_json& object, const char* name) const {
        const ordered_json& value = at(object, name);
        if (!value.is_array()) refuse(fmt::format("'{}' is not a list", name));
        return value;
    }
};

MapDrive drive_of(const ordered_json& json, const IndexPlace& place) {
    return {place.text(json, "name"), place.count(json, "scans")};
}

MapTile tile_of(const ordered_json& json, const IndexPlace& place) {
    constexpr std::int64_t kFarthest = std::int64_t{1} << 40;
    MapTile tile;
    tile.name = place.text(json, "name");
    tile.level = static_cast<int>(place.whole(json, "level", 0, kMostLevel));
    tile.x = place.whole(json, "x", -kFarthest, kFarthest);
    tile.y = place.whole(json, "y", -kFarthest, kFarthest);
    tile.min = place.vector(json, "min");
    tile.max = place.vector(json, "max");
    tile.voxels = place.count(json, "voxels");
    tile.scans = place.count(json, "scans");
    tile.file = place.text(json, "file");
    tile.is_whole = tile.name == kWholeTile;
    if (!tile.is_whole && tile.name != tile_name(tile.level, tile.x, tile.y)) {
        place.refuse(fmt::format("the name '{}' is not that of level {}, x {}, y {}", tile.name,
                                 tile.level, tile.x, tile.y));
    }
    if (tile.file.empty() || fs::path(tile.file).filename() != tile.file)
        place.refuse(fmt::format("the file '{}' does not lie beside the index", tile.file));
    return tile;
}

using Key = std::tuple<int, std::int64_t, std::int64_t>;

/// A place that two tiles cover would be in every export twice.
void refuse_overlaps(const MapIndex& index, const IndexPlace& place) {
    std::set<Key> keys;
    const bool has_whole = std::any_of(index.tiles.begin(), index.tiles.end(),
                                       [](const MapTile& tile) { return tile.is_whole; });
    if (has_whole && index.tiles.size() > 1)
        place.refuse("tile all covers everything, but there are others");
    for (const MapTile& tile : index.tiles) {
        if (!keys.emplace(tile.level, tile.x, tile.y).second)
            place.refuse(fmt::format("tile {} is listed twice", tile.name));
    }
    for (const MapTile& tile : index.tiles) {
        std::int64_t x = tile.x, y = tile.y;
        for (int level = tile.level + 1; level <= kMostLevel; ++level) {
            x >>= 1;
            y >>= 1;
            if (!keys.contains({level, x, y})) continue;
            place.refuse(
                fmt::format("tile {} lies within tile {}", tile.name, tile_name(level, x, y)));
        }
    }
}

void check_version(const ordered_json& json, const IndexPlace& place) {
    const std::int64_t version = place.whole(json, "version", 0, 1'000'000);
    if (version == kMapVersion) return;
    throw InputError(place.file, "",
                     fmt::format("is a map of version {}, and this program reads version {}; use "
                                 "the program that wrote it, or run again",
                                 version, kMapVersion));
}

/// One line each, so that a map of ten thousand tiles can still be read and compared.
template <class List, class ToJson>
std::string lines_of(const List& list, const ToJson& to_object) {
    std::string text = "[";
    const char* before = "\n    ";
    for (const auto& item : list) {
        text += before;
        text += to_object(item).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
        before = ",\n    ";
    }
    return text + (list.empty() ? "]" : "\n  ]");
}

}  // namespace

double side_of(double voxel_size, int level) { return std::ldexp(kTileVoxels * voxel_size, level); }

TileSquare filled_square(const MapIndex& index, const MapTile& tile) {
    const Eigen::Vector2d low = tile.min.head<2>().array() - index.voxel_size / 2.0;
    const Eigen::Vector2d size = (tile.max - tile.min).head<2>();
    return {low.x(), low.y(), size.maxCoeff() + index.voxel_size};
}

TileSquare square_of(const MapIndex& index, const MapTile& tile) {
    if (tile.is_whole) return filled_square(index, tile);
    const double side = side_of(index.voxel_size, tile.level);
    return {static_cast<double>(tile.x) * side, static_cast<double>(tile.y) * side, side};
}

std::string tile_name(int level, std::int64_t x, std::int64_t y) {
    return fmt::format("{}_{}_{}", level, x, y);
}

fs::path map_folder_of(const fs::path& path) {
    if (fs::exists(path / kMapFolder / kIndex)) return path / kMapFolder;
    return path.filename() == kIndex ? path.parent_path() : path;
}

bool is_tiled_map(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_regular_file(path / kMapFolder / kIndex, ignored)) return true;
    const fs::path file = path.filename() == kIndex ? path : path / kIndex;
    // An index of tiles as LAS has the same form, but is no map to be read.
    return fs::is_regular_file(file, ignored) &&
           fs::absolute(file).lexically_normal().parent_path().filename() == kMapFolder;
}

MapIndex read_map_index(const fs::path& folder) {
    const fs::path file = folder / kIndex;
    const ordered_json json = ordered_json::parse(io::read_file(file), nullptr, false);
    if (json.is_discarded() || !json.is_object()) {
        throw InputError(file, "",
                         "is not JSON; expected the index that a run over several recordings "
                         "writes into OUT/map");
    }
    const IndexPlace whole{file, ""};
    check_version(json, whole);
    MapIndex index;
    if (!whole.at(json, "voxel_size").is_number() || !(json["voxel_size"].get<double>() > 0.0))
        whole.refuse("'voxel_size' is not a length");
    index.voxel_size = json["voxel_size"].get<double>();
    for (const ordered_json& drive : whole.list(json, "drives"))
        index.drives.push_back(
            drive_of(drive, {file, fmt::format("drive {}", index.drives.size())}));
    for (const ordered_json& tile : whole.list(json, "tiles"))
        index.tiles.push_back(tile_of(tile, {file, fmt::format("tile {}", index.tiles.size())}));
    refuse_overlaps(index, whole);
    return index;
}

std::string to_json(const MapIndex& index) {
    const std::string drives = lines_of(index.drives, [](const MapDrive& drive) {
        return ordered_json{{"name", drive.name}, {"scans", drive.scans}};
    });
    const std::string tiles = lines_of(index.tiles, [](const MapTile& tile) {
        return ordered_json{
            {"name", tile.name},     {"level", tile.level},       {"x", tile.x},
            {"y", tile.y},           {"min", array_of(tile.min)}, {"max", array_of(tile.max)},
            {"voxels", tile.voxels}, {"scans", tile.scans},       {"file", tile.file}};
    });
    return fmt::format(
        "{{\n  \"version\": {},\n  \"voxel_size\": {},\n  \"drives\": {},\n  \"tiles\": {}\n}}\n",
        index.version, ordered_json(index.voxel_size).dump(), drives, tiles);
}

void write_map_index(const fs::path& folder, const MapIndex& index) {
    io::write_file(folder / kIndex, to_json(index));
}

}  // namespace dynamic_filter::app
