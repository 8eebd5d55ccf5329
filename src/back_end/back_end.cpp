// SPDX-License-Identifier: MIT
#include "dynamic_filter/back_end/back_end.hpp"

#include <algorithm>
#include <numbers>

#include "dynamic_filter/back_end/normals.hpp"
#include "dynamic_filter/front_end/front_end.hpp"

namespace dynamic_filter {

namespace {

std::vector<std::uint32_t> own_voxels(const Points& points, float voxel_size, VoxelIndex& index) {
    std::vector<std::uint32_t> ids;
    ids.reserve(points.size());
    for (const Point& p : points) {
        if (const auto key = voxel_of(p, voxel_size)) ids.push_back(index.insert(*key));
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

ImageGrid sphere(const Config::BackEnd& config, const BeamPattern& beams) {
    // One pixel shape for all directions: from a foreign pose the beams' raster is gone.
    const float spacing = std::max(beams.azimuth_spacing, beams.elevation_spacing);
    const float step = pixel_step(config.image_step_deg, config.image_step_beams, spacing);
    constexpr float kPole = 0.5F * std::numbers::pi_v<float>;
    return make_grid(step, step, -kPole, kPole);
}

}  // namespace

void BackEnd::insert(Submap submap, const BeamPattern& beams, StageTimes& times) {
    grid_ = sphere(config_, beams);
    BufferedSubmap buffered{.submap = std::move(submap)};
    timed(times, "voxelization", [&] {
        buffered.voxels =
            own_voxels(buffered.submap.points, static_cast<float>(config_.voxel_size), voxels_);
    });
    slot_of_voxel_.resize(voxels_.size(), 0);
    if (config_.enabled && config_.incident_correction) {
        timed(times, "normals", [&] {
            buffered.normals =
                estimate_normals(buffered.submap.points, static_cast<float>(config_.voxel_size));
        });
    }
    buffer_.push_back(std::move(buffered));
}

LocalMap BackEnd::local_map(const Pose& T_map_query, StageTimes& times) {
    return buffer_.empty() ? LocalMap{} : local_map(T_map_query, buffer_.size() - 1, times);
}

LocalMap BackEnd::local_map_of(std::size_t submap, StageTimes& times) {
    return local_map(buffer_[submap].submap.T_map_submap, submap, times);
}

LocalMap BackEnd::local_map(const Pose& T_map_query, std::size_t anchor, StageTimes& times) {
    std::vector<const BufferedSubmap*> nearby;
    for (const std::size_t i :
         search_radius(buffer_, T_map_query.translation(), config_.search_radius,
                       static_cast<std::size_t>(config_.max_submaps), anchor)) {
        nearby.push_back(&buffer_[i]);
    }
    const auto boundaries = timed(times, "visibility_check", [&] {
        return check_visibility(nearby, T_map_query, grid_, config_);
    });
    return timed(times, "occupancy", [&] {
        return occupancy(count_owners(nearby, slot_of_voxel_), boundaries, voxels_, T_map_query,
                         grid_, config_);
    });
}

}  // namespace dynamic_filter
