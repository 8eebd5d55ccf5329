// SPDX-License-Identifier: MIT
// This file is compiled several times, like project_kernel.cpp.
#include "geometry/voxel_kernel.hpp"

namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL {

namespace {

constexpr std::int32_t kCellLimit = 1 << 20;  // as in geometry/voxel.hpp

/// The half cell of a coordinate, or -kCellLimit, which no valid key has. There are no branches.
inline std::int32_t half_cell(float coordinate, float half_cells_per_metre) {
    const float halves = coordinate * half_cells_per_metre;
    // Comparisons with NaN are false, so NaN is not small.
    const bool small = (halves >= -1.0F * kCellLimit) & (halves < 1.0F * kCellLimit);
    const float safe = small ? halves : -1.0F * kCellLimit;
    const auto cut = static_cast<std::int32_t>(safe);
    return cut - (static_cast<float>(cut) > safe ? 1 : 0);
}

constexpr std::size_t kBatch = 256;  // points per batch; each step of a batch can be vectorized

struct HalfCells {
    std::int32_t x[kBatch], y[kBatch], z[kBatch], measured[kBatch];
};

inline void to_map(const VoxelArgs& args, std::size_t begin, std::size_t count, HalfCells& half) {
    const float* const __restrict xyz = args.xyz + 3 * begin;
    const float* const m = args.matrix;
    const float m00 = m[0], m01 = m[1], m02 = m[2], m03 = m[3];
    const float m10 = m[4], m11 = m[5], m12 = m[6], m13 = m[7];
    const float m20 = m[8], m21 = m[9], m22 = m[10], m23 = m[11];
    const float scale = args.half_cells_per_metre;
    const float least = args.origin_is_a_point ? -1.0F : 0.0F;
    float* const __restrict map_xyz = args.map_xyz + 3 * begin;
    for (std::size_t i = 0; i < count; ++i) {
        const float px = xyz[3 * i], py = xyz[3 * i + 1], pz = xyz[3 * i + 2];
        const float x = m00 * px + m01 * py + m02 * pz + m03;
        const float y = m10 * px + m11 * py + m12 * pz + m13;
        const float z = m20 * px + m21 * py + m22 * pz + m23;
        map_xyz[3 * i] = x;
        map_xyz[3 * i + 1] = y;
        map_xyz[3 * i + 2] = z;
        half.x[i] = half_cell(x, scale);
        half.y[i] = half_cell(y, scale);
        half.z[i] = half_cell(z, scale);
        half.measured[i] = px * px + py * py + pz * pz > least ? 1 : 0;  // also false for NaN
    }
}

inline void to_keys(const HalfCells& half, std::size_t count, std::uint64_t* __restrict keys) {
    const auto field = [](std::int32_t h) {
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>((h >> 1) + kCellLimit));
    };
    for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t x = half.x[i], y = half.y[i], z = half.z[i];
        const bool has_key =
            (half.measured[i] != 0) & (x > -kCellLimit) & (y > -kCellLimit) & (z > -kCellLimit);
        const std::uint64_t key = field(x) << 42 | field(y) << 21 | field(z);
        keys[i] = has_key ? key : ~std::uint64_t{0};
    }
}

}  // namespace

void to_voxels(const VoxelArgs& args) {
    HalfCells half;
    for (std::size_t begin = 0; begin < args.count; begin += kBatch) {
        const std::size_t left = args.count - begin;
        const std::size_t count = left < kBatch ? left : kBatch;
        to_map(args, begin, count, half);
        to_keys(half, count, args.keys + begin);
    }
}

}  // namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL
