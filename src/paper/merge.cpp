// SPDX-License-Identifier: MIT
#include "paper/merge.hpp"

#include <limits>

namespace dynamic_filter {

void merge(MergedMap& merged, const LocalMap& local, const Pose& T_map_query,
           const VoxelIndex& index, double voxel_size) {
    merged.probability.resize(index.size());
    merged.distance_sq.resize(index.size(), std::numeric_limits<double>::infinity());
    const Point position = T_map_query.translation().cast<float>();
    for (std::size_t i = 0; i < local.voxels.size(); ++i) {
        const std::uint32_t voxel = local.voxels[i];
        const Point at = center(index.key(voxel), static_cast<float>(voxel_size));
        const double distance_sq = (at - position).squaredNorm();
        if (distance_sq < merged.distance_sq[voxel]) {
            merged.distance_sq[voxel] = distance_sq;
            merged.probability[voxel] = local.probability[i];
        }
    }
}

}  // namespace dynamic_filter
