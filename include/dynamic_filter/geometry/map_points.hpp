// SPDX-License-Identifier: MIT
/// A scan in the map: where its points lie, and in which voxels.
#pragma once

#include <span>
#include <vector>

#include "dynamic_filter/geometry/voxel.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

constexpr VoxelKey kNoKey = ~VoxelKey{0};

/// Parallel to the points of a scan.
struct MapPoints {
    Points points;               ///< map frame
    std::vector<VoxelKey> keys;  ///< kNoKey: not measured, or beyond the reach of a key
};

/// Of T_map_sensor * p for every point [sensor frame]; keys as voxel_of() gives them. Bit-identical
/// at every instruction-set level. Thread-safe; `out` is resized.
void to_voxels(std::span<const Point> points, const Pose& T_map_sensor, float voxel_size,
               MapPoints& out);
/// The same of points in the map frame, where (0, 0, 0) is a point as any other.
void to_voxels(std::span<const Point> map_points, float voxel_size, MapPoints& out);

}  // namespace dynamic_filter
