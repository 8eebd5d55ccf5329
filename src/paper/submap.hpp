// SPDX-License-Identifier: MIT
/// A static submap (Sec. III-B).
#pragma once

#include <tsl/robin_set.h>

#include <vector>

#include "dynamic_filter/types.hpp"
#include "geometry/voxel.hpp"
#include "paper/window.hpp"

namespace dynamic_filter {

struct Submap {
    Pose T_map_submap = Pose::Identity();  ///< mean pose of the scans of the submap
    Points points;                         ///< map frame, thinned to one per cell of half a voxel
};

/// Transforms the points of one scan into the map frame. All stages use this function, so that they
/// get bit-identical coordinates.
void to_map(const Points& points, const Pose& T_map_sensor, Points& out);
inline void to_map(const Scan& scan, Points& out) { to_map(scan.points, scan.T_world_sensor, out); }

/// Thins points: it keeps the first point of every cell of half a voxel. Each voxel consists of
/// whole cells, so thinning never changes which voxels hold points.
class Thinner {
public:
    explicit Thinner(float voxel_size) : inverse_cell_(2.0F / voxel_size) {}
    /// Adds the points of a scan that have the label `kept` [map frame].
    void add(const Points& points, const Labels& labels, Label kept);
    Points moved_points() { return std::move(points_); }
    [[nodiscard]] const Points& points() const { return points_; }

private:
    float inverse_cell_;
    tsl::robin_set<VoxelKey, VoxelHash> cells_;
    Points points_;
};

/// The voxel of a point, computed from its half cell; empty if the point is too far away for a key.
std::optional<VoxelKey> voxel_of(const Point& point, float voxel_size);

}  // namespace dynamic_filter
