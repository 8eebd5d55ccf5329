// SPDX-License-Identifier: MIT
/// Voxels as 64-bit keys: 21 bits per axis. Points reach voxels by way of half cells, so +-105 km
/// at voxels of 0.2 m, from the map frame's origin.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

using VoxelKey = std::uint64_t;

/// In place of a voxel's number: there is none.
constexpr std::uint32_t kNoVoxel = UINT32_MAX;

/// Integer cell of a point; cells are half-open and use floor, so negative coordinates are fine.
using Cell = Eigen::Vector3i;

constexpr int kCellLimit = 1 << 20;

inline bool fits(const Cell& c) {
    return (c.array() >= -kCellLimit && c.array() < kCellLimit).all();
}

/// Empty for points that are not finite or too far for a key.
inline std::optional<Cell> cell_of(const Point& p, float inverse_size) {
    const Eigen::Array3f scaled = (p * inverse_size).array().floor();
    if (!(scaled.abs() < static_cast<float>(kCellLimit)).all()) return std::nullopt;  // also NaN
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

/// Murmur's finaliser: neighbouring keys spread over the whole table.
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
