// SPDX-License-Identifier: MIT
#include "paper/occupancy.hpp"

#include <bit>

#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter {

namespace {

/// One bit per submap whose visibility boundary reaches the depth channel in the pixel.
std::uint64_t reaching(std::span<const VisibilityBoundary> boundaries, std::size_t pixel,
                       float channel) {
    std::uint64_t submaps = 0;
    for (std::size_t j = 0; j < boundaries.size(); ++j) {
        submaps |= static_cast<std::uint64_t>(boundaries[j][pixel] >= channel) << j;
    }
    return submaps;
}

std::uint64_t all_of(std::size_t submaps) {
    return submaps == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << submaps) - 1;
}

}  // namespace

Ownership count_owners(std::span<const BufferedSubmap* const> nearby,
                       std::vector<std::uint32_t>& slot_of_voxel) {
    Ownership result;
    for (std::size_t j = 0; j < nearby.size(); ++j) {
        for (const std::uint32_t voxel : nearby[j]->voxels) {
            // 1 + index in the result; 0: not in the result yet.
            std::uint32_t& slot = slot_of_voxel[voxel];
            if (slot == 0) {
                result.voxels.push_back(voxel);
                result.owners.push_back(0);
                slot = static_cast<std::uint32_t>(result.voxels.size());
            }
            result.owners[slot - 1] |= std::uint64_t{1} << j;
        }
    }
    for (const std::uint32_t voxel : result.voxels) slot_of_voxel[voxel] = 0;
    return result;
}

LocalMap occupancy(Ownership ownership, std::span<const VisibilityBoundary> boundaries,
                   const VoxelIndex& index, float voxel_size, const Pose& T_map_query,
                   const ImageGrid& grid, const BackEndConfig& config) {
    const auto depth = static_cast<float>(config.depth_channel);
    const Eigen::Isometry3f T_query_map = T_map_query.inverse().cast<float>();
    std::vector<float> probability(ownership.voxels.size());
    parallel_for(ownership.voxels.size(), 4096, [&](std::size_t begin, std::size_t end) {
        Points centers(end - begin);
        Projection seen;
        for (std::size_t i = begin; i < end; ++i) {
            centers[i - begin] = center(index.key(ownership.voxels[i]), voxel_size);
        }
        project(centers, T_query_map, grid, seen);
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint64_t owners = ownership.owners[i];
            const std::int32_t pixel = seen.pixel[i - begin];
            std::uint64_t checked = owners;
            if (!config.visibility_check) {
                checked = all_of(boundaries.size());
            } else if (pixel >= 0) {
                checked |= reaching(boundaries, static_cast<std::size_t>(pixel),
                                    depth_channel(seen.range[i - begin], depth));
            }
            probability[i] = static_cast<float>(std::popcount(owners)) /
                             static_cast<float>(std::popcount(checked));
        }
    });
    return {std::move(ownership.voxels), std::move(probability)};
}

}  // namespace dynamic_filter
