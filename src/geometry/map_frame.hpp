// SPDX-License-Identifier: MIT
/// The frame of a map: the world, shifted by a whole number of voxels to where the map begins, so
/// that floats hold its coordinates.
#pragma once

#include <optional>

#include "dynamic_filter/types.hpp"
#include "geometry/map_points.hpp"
#include "geometry/voxel_index.hpp"

namespace dynamic_filter {

/// A scan in the map frame, with the voxel of each of its points.
struct LocatedScan {
    MapPoints in_map;
    PointVoxels voxels;  ///< kNoVoxel: not measured, or in no voxel of the map
};

struct MapFrame {
    double voxel_size = 0.0;  ///< [m]
    /// Origin of the map frame [m, world frame]; empty before the first scan.
    std::optional<Eigen::Vector3d> origin{};

    /// The first scan defines the origin.
    void begin(const Pose& T_world_sensor);
    /// T_map_sensor. Call it after begin().
    [[nodiscard]] Pose to_map(const Pose& T_world_sensor) const;
    /// The points of a scan in the map. No point has a voxel before begin(). Throws Error if the
    /// scan has no pose.
    [[nodiscard]] LocatedScan locate(const Scan& scan, const VoxelIndex& voxels) const;
    /// [m, world frame] Center of a voxel.
    [[nodiscard]] Eigen::Vector3d center_of(VoxelKey key) const;
};

}  // namespace dynamic_filter
