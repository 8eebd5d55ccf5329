// SPDX-License-Identifier: MIT
// The output folder of a run over several drives, made up: streets and houses around the origin.
#pragma once

#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "dynamic_filter/writers.hpp"
#include "formats/voxel_map/map_index.hpp"

namespace dynamic_filter::app {

inline constexpr double kSampleVoxel = 0.2;

/// A voxel of the sample, as it is in the file.
struct SampleVoxel {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    float probability = 0.0F;
    std::uint32_t scans = 0;
    std::vector<std::uint32_t> drives;
};

/// Height of the houses at a place [m]; 0 on streets, which lie 40 m apart.
inline double sample_height(double x, double y) {
    const auto block = [](double v) { return std::floor(v / 40.0); };
    const auto within = [](double v) { return v - 40.0 * std::floor(v / 40.0); };
    if (within(x) < 12.0 || within(y) < 12.0) return 0.0;
    return 5.0 + std::fmod(std::abs(37.0 * block(x) + 91.0 * block(y)), 17.0);
}

/// Roofs, walls and ground of a square; one column of voxels every `step`.
inline std::vector<SampleVoxel> sample_voxels(const MapTile& tile, std::size_t drives,
                                              double step) {
    const double side = side_of(kSampleVoxel, tile.level);
    const Eigen::Vector2d low(static_cast<double>(tile.x) * side,
                              static_cast<double>(tile.y) * side);
    const std::size_t words = std::max<std::size_t>(1, (drives + 31) / 32);
    std::vector<SampleVoxel> voxels;
    for (double x = 0.0; x < side - 1e-6; x += step) {
        for (double y = 0.0; y < side - 1e-6; y += step) {
            const auto middle = [](double v) {
                return (std::floor(v / kSampleVoxel + 1e-6) + 0.5) * kSampleVoxel;
            };
            const double px = middle(low.x() + x), py = middle(low.y() + y);
            const double top = sample_height(px, py);
            const bool wall = top > 0.0 && (sample_height(px - step, py) == 0.0 ||
                                            sample_height(px, py - step) == 0.0);
            for (double z = wall ? 0.0 : top; z <= top + 1e-6; z += kSampleVoxel) {
                SampleVoxel v{{px, py, middle(z + 0.02 * px)}, 0.9F, 0, {}};
                v.scans = static_cast<std::uint32_t>(5.0 + std::abs(px) + 2.0 * z);
                v.probability = 0.6F + 0.4F * static_cast<float>(v.scans % 10) / 10.0F;
                v.drives.resize(words);
                const std::size_t drive = static_cast<std::size_t>(std::abs(px) / 40.0) % drives;
                for (const std::size_t d : {drive, (drive + 1) % drives})
                    v.drives[d / 32] |= 1U << d % 32;
                voxels.push_back(v);
            }
        }
    }
    return voxels;
}

inline io::Cloud sample_cloud(const std::vector<SampleVoxel>& voxels, std::size_t words) {
    io::Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, io::FieldType::f64);
    add_field(cloud, "probability", io::FieldType::f32);
    add_field(cloud, "scans", io::FieldType::u32);
    add_field(cloud, "sessions", io::FieldType::u32, static_cast<std::uint32_t>(words));
    for (const SampleVoxel& voxel : voxels) {
        const std::size_t at = cloud.data.size();
        cloud.data.resize(at + cloud.point_bytes);
        std::byte* record = cloud.data.data() + at;
        std::memcpy(record, voxel.position.data(), 24);
        std::memcpy(record + 24, &voxel.probability, 4);
        std::memcpy(record + 28, &voxel.scans, 4);
        std::memcpy(record + 32, voxel.drives.data(), 4 * words);
    }
    return cloud;
}

/// Squares of level 2 from -2 to 1 in both axes, and one of them as four of level 1.
inline std::vector<MapTile> sample_squares(int level) {
    std::vector<MapTile> tiles;
    const auto add = [&](int at, std::int64_t x, std::int64_t y) {
        MapTile tile;
        tile.level = at;
        tile.x = x;
        tile.y = y;
        tile.name = tile_name(at, x, y);
        tile.file = tile.name + ".pcd";
        tiles.push_back(tile);
    };
    for (std::int64_t x = -2; x < 2; ++x) {
        for (std::int64_t y = -2; y < 2; ++y) {
            if (x == 1 && y == 1) continue;
            add(level, x, y);
        }
    }
    for (std::int64_t k = 0; k < 4; ++k) add(level - 1, 2 + k % 2, 2 + k / 2);
    return tiles;
}

/// Writes OUT/map/ with 19 tiles; returns its index. `step` [m] from one column to the next.
inline MapIndex write_sample_map(const std::filesystem::path& out, std::size_t drives = 3,
                                 int level = 1, double step = 0.8) {
    std::filesystem::create_directories(out / "map");
    MapIndex index;
    index.voxel_size = kSampleVoxel;
    for (std::size_t d = 0; d < drives; ++d)
        index.drives.push_back({"drive_" + std::to_string(d + 1), 100 + d});
    const std::size_t words = std::max<std::size_t>(1, (drives + 31) / 32);
    for (MapTile tile : sample_squares(level)) {
        const std::vector<SampleVoxel> voxels = sample_voxels(tile, drives, step);
        tile.min = tile.max = voxels.front().position;
        for (const SampleVoxel& voxel : voxels) {
            tile.min = tile.min.cwiseMin(voxel.position);
            tile.max = tile.max.cwiseMax(voxel.position);
        }
        tile.voxels = voxels.size();
        tile.scans = 40 + static_cast<std::uint64_t>(10 * (tile.x + 3));
        io::write_pcd(out / "map" / tile.file, sample_cloud(voxels, words));
        index.tiles.push_back(tile);
    }
    write_map_index(out / "map", index);
    return index;
}

}  // namespace dynamic_filter::app
