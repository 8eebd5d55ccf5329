// SPDX-License-Identifier: MIT
/// The points of a scan in the map frame, and the voxel of each point.
#pragma once

#include <span>
#include <vector>

#include "dynamic_filter/types.hpp"
#include "geometry/voxel.hpp"

namespace dynamic_filter {

constexpr VoxelKey kNoKey = ~VoxelKey{0};

/// All arrays are parallel to the points of a scan.
struct MapPoints {
    Points points;               ///< map frame
    std::vector<VoxelKey> keys;  ///< kNoKey: not measured, or too far away for a voxel key
};

/// Computes T_map_sensor * p for every point [sensor frame] and its voxel key, as voxel_of() gives
/// it. The results are bit-identical at every instruction-set level. `out` is resized. Thread-safe.
void to_voxels(std::span<const Point> points, const Pose& T_map_sensor, float voxel_size,
               MapPoints& out);
/// The same for points that are already in the map frame. Here (0, 0, 0) is a valid point.
void to_voxels(std::span<const Point> map_points, float voxel_size, MapPoints& out);

}  // namespace dynamic_filter
