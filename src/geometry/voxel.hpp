// SPDX-License-Identifier: MIT
/// Voxels as 64-bit keys with 21 bits per axis. Keys are computed from cells of half a voxel, so
/// the reach is +-105 km from the origin of the map frame for voxels of 0.2 m.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

using VoxelKey = std::uint64_t;

/// Stands for "no voxel" in place of the number of a voxel.
constexpr std::uint32_t kNoVoxel = UINT32_MAX;

/// Integer coordinates of the cell of a point. Cells are half-open intervals; coordinates are
/// rounded down, so negative coordinates are correct, too.
using Cell = Eigen::Vector3i;

constexpr int kCellLimit = 1 << 20;

inline bool fits(const Cell& c) {
    return (c.array() >= -kCellLimit && c.array() < kCellLimit).all();
}

/// Empty if the point is not finite or too far away for a key.
inline std::optional<Cell> cell_of(const Point& p, float inverse_size) {
    const Eigen::Array3f scaled = (p * inverse_size).array().floor();
    if (!(scaled.abs() < static_cast<float>(kCellLimit)).all())
        return std::nullopt;  // also false for NaN
    return scaled.cast<int>().matrix();
}

inline VoxelKey pack(const Cell& c) {
    const auto field = [](int v) { return static_cast<VoxelKey>(v + kCellLimit); };
    return field(c.x()) << 42 | field(c.y()) << 21 | field(c.z());
}

inline Cell unpack(VoxelKey key) {
    const auto field = [&](int shift) {
        return static_cast<int>(key >> shift & 0x1FFFFF) - kCellLimit;
    };
    return {field(42), field(21), field(0)};
}

inline Point center(VoxelKey key, float size) {
    return (unpack(key).cast<float>().array() + 0.5F).matrix() * size;
}

/// Final mixing step of MurmurHash3: it spreads neighboring keys over the whole table.
struct VoxelHash {
    std::size_t operator()(VoxelKey k) const {
        k ^= k >> 33;
        k *= 0xff51afd7ed558ccdULL;
        k ^= k >> 33;
        k *= 0xc4ceb9fe1a85ec53ULL;
        return static_cast<std::size_t>(k ^ (k >> 33));
    }
};

}  // namespace dynamic_filter
