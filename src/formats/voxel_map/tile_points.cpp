// SPDX-License-Identifier: MIT
#include "formats/voxel_map/tile_points.hpp"

#include <fmt/format.h>
#include <tsl/robin_set.h>

#include <array>
#include <cstring>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "geometry/world_voxel.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

const io::Field& field_of(const io::Cloud& cloud, const fs::path& file, const char* name,
                          io::FieldType type, std::size_t count) {
    const io::Field* field = cloud.find(name);
    if (field == nullptr) throw InputError(file, "", fmt::format("has no field '{}'", name));
    if (field->type != type || field->count != count) {
        throw InputError(file, "",
                         fmt::format("field '{}' has another type or number of values than this "
                                     "program writes; is the index of another run?",
                                     name));
    }
    return *field;
}

template <class T>
void read_column(const io::Cloud& cloud, const io::Field& field, std::vector<T>& values) {
    values.resize(cloud.size() * field.count);
    const std::size_t bytes = sizeof(T) * field.count;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        std::memcpy(values.data() + i * field.count,
                    cloud.data.data() + i * cloud.point_bytes + field.offset, bytes);
    }
}

void read_positions(const io::Cloud& cloud, const fs::path& file, TilePoints& points) {
    points.positions.resize(cloud.size());
    constexpr std::array names = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> column;
        read_column(
            cloud,
            field_of(cloud, file, names[static_cast<std::size_t>(axis)], io::FieldType::f64, 1),
            column);
        for (std::size_t i = 0; i < column.size(); ++i) points.positions[i][axis] = column[i];
    }
}

/// A voxel elsewhere would be in the wrong place of an export. Centres are sums of floats.
void check_places(const TilePoints& points, const MapIndex& index, const MapTile& tile,
                  const fs::path& file) {
    const TileSquare square = square_of(index, tile);
    const double slack = index.voxel_size / 2.0;
    const Eigen::Array2d low = Eigen::Array2d(square.west, square.south) - slack;
    for (const Eigen::Vector3d& p : points.positions) {
        const Eigen::Array2d at = p.head<2>().array() - low;
        if (p.allFinite() && (at >= 0.0).all() && (at <= square.side + 2.0 * slack).all()) continue;
        throw InputError(file, "",
                         fmt::format("the voxel at {:.2f} {:.2f} {:.2f} lies outside of tile {}; "
                                     "is the file damaged?",
                                     p.x(), p.y(), p.z(), tile.name));
    }
}

}  // namespace

void TilePoints::append(const TilePoints& other, std::size_t i) {
    positions.push_back(other.positions[i]);
    probability.push_back(other.probability[i]);
    scans.push_back(other.scans[i]);
    const auto begin = other.drives.begin() + static_cast<std::ptrdiff_t>(i * words);
    drives.insert(drives.end(), begin, begin + static_cast<std::ptrdiff_t>(words));
}

std::size_t drive_words(std::size_t drives) { return std::max<std::size_t>(1, (drives + 31) / 32); }

TilePoints read_tile(const fs::path& folder, const MapIndex& index, const MapTile& tile) {
    const fs::path file = folder / tile.file;
    if (tile.voxels == 0) {  // then there need not be a file
        TilePoints none;
        none.words = drive_words(index.drives.size());
        return none;
    }
    const io::Cloud cloud = io::read_pcd(file);
    if (cloud.size() != tile.voxels) {
        throw InputError(file, "",
                         fmt::format("has {} voxels, and the index says {}; copy the folder again "
                                     "from where the run wrote it",
                                     cloud.size(), tile.voxels));
    }
    TilePoints points;
    points.words = drive_words(index.drives.size());
    read_positions(cloud, file, points);
    read_column(cloud, field_of(cloud, file, "probability", io::FieldType::f32, 1),
                points.probability);
    read_column(cloud, field_of(cloud, file, "scans", io::FieldType::u32, 1), points.scans);
    read_column(cloud, field_of(cloud, file, "sessions", io::FieldType::u32, points.words),
                points.drives);
    check_places(points, index, tile, file);
    return points;
}

TilePoints thinned(const TilePoints& points, double spacing) {
    TilePoints result;
    result.words = points.words;
    tsl::robin_set<WorldVoxel, NumbersHash> taken;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool is_first = taken.insert(world_voxel(points.positions[i], spacing)).second;
        if (is_first) result.append(points, i);
    }
    return result;
}

}  // namespace dynamic_filter::app
