// SPDX-License-Identifier: MIT
/// Clusters of a scan: groups of points that stand on the ground and are separate from each other.
#pragma once

#include <cstdint>
#include <vector>

#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/types.hpp"
#include "geometry/voxel_index.hpp"

namespace dynamic_filter {

/// The cluster of each point.
struct Clusters {
    std::vector<std::uint32_t> of_points;  ///< parallel to the points; kNoCluster: no cluster
    std::uint32_t count = 0;
};
constexpr std::uint32_t kNoCluster = ~std::uint32_t{0};

/// Finds clusters of points that stand on the ground. The points are seen from above, in a raster;
/// cells with points that touch each other form one cluster. The z axis of the sensor is taken as
/// the vertical, and the lowest point nearby as the ground. Points less than `ground` or more than
/// `top` above it are left out. A group longer than `largest` is no cluster (walls, hedges, dense
/// crowds). If the sensor is tilted, or if it sees no ground, few clusters are found. Points are in
/// the sensor frame; points without a voxel are left out. Thread-safe. Cost: linear in the points
/// and in the cells of the raster.
Clusters find_clusters(const Points& points, const PointVoxels& voxels,
                       const ScansConfig::Instances& config);

}  // namespace dynamic_filter
