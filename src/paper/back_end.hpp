// SPDX-License-Identifier: MIT
/// The map-to-map back-end (Sec. III-C): it takes static submaps, and computes the static local map
/// at any pose.
#pragma once

#include <vector>

#include "dynamic_filter/range_image.hpp"
#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "geometry/voxel_index.hpp"
#include "paper/occupancy.hpp"
#include "paper/submap.hpp"
#include "paper/submap_buffer.hpp"

namespace dynamic_filter {

/// Single caller. Poses and points are in the map frame.
class BackEnd {
public:
    explicit BackEnd(const Config& config)
        : config_(config.back_end),
          voxel_size_(static_cast<float>(config.map.voxel_size)),
          search_radius_(config.map.search_radius) {}

    /// Adds a submap to the buffer, numbers its voxels, and computes its normals.
    void insert(Submap submap, const BeamPattern& beams, StageTimes& times);

    /// The occupancy of every voxel that belongs to a submap near the query pose. Empty before the
    /// first insert().
    LocalMap local_map(const Pose& T_map_query, StageTimes& times);

    /// The local map at the pose of a submap of the buffer. That submap is always among those used.
    LocalMap local_map_of(std::size_t submap, StageTimes& times);

    /// Removes the submaps whose pose lies beyond `radius` [m] of a place, then the farthest
    /// submaps until the rest holds at most `most_points` points; one submap always remains. Voxels
    /// get new numbers. Returns the distance [m] within which nothing was removed.
    double keep_within(const Eigen::Vector3d& center, double radius, std::size_t most_points);
    /// Number of points of all submaps.
    [[nodiscard]] std::size_t points() const;

    [[nodiscard]] const std::vector<BufferedSubmap>& buffer() const { return buffer_; }
    [[nodiscard]] const VoxelIndex& voxels() const { return voxels_; }

private:
    LocalMap local_map(const Pose& T_map_query, std::size_t anchor, StageTimes& times);

    BackEndConfig config_;
    float voxel_size_;      // [m]
    double search_radius_;  // [m]
    ImageGrid grid_;        // covers the whole sphere, for any query pose
    std::vector<BufferedSubmap> buffer_;
    VoxelIndex voxels_;
    std::vector<std::uint32_t> slot_of_voxel_;  // work array of count_owners()
};

}  // namespace dynamic_filter
