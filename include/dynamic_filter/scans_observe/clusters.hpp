// SPDX-License-Identifier: MIT
/// The things in one scan that stand apart from each other.
#pragma once

#include <cstdint>
#include <vector>

#include "dynamic_filter/config.hpp"
#include "dynamic_filter/geometry/voxel_index.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Which points belong to the same thing.
struct Clusters {
    std::vector<std::uint32_t> of_points;  ///< parallel to the points; kNoCluster: none
    std::uint32_t count = 0;
};
constexpr std::uint32_t kNoCluster = ~std::uint32_t{0};

/// Clusters of points that stand on the ground, seen from above: the sensor's z axis is taken for
/// up, the ground is the lowest point nearby, points less than `ground` or more than `top` above it
/// are left out, and cells of the raster that touch each other are one cluster. What is longer than
/// `largest` is part of no cluster: walls, hedges, dense crowds. Where the sensor is tilted, or
/// where there is no ground, few clusters are found. Points in the sensor frame; those of no voxel
/// are left out. Thread-safe. Cost: points, and cells of the raster.
Clusters find_clusters(const Points& points, const PointVoxels& voxels,
                       const ScansConfig::Instances& config);

}  // namespace dynamic_filter
