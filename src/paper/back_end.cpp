// SPDX-License-Identifier: MIT
#include "paper/back_end.hpp"

#include <algorithm>
#include <numbers>

#include "geometry/map_points.hpp"
#include "paper/front_end.hpp"
#include "paper/normals.hpp"

namespace dynamic_filter {

namespace {

std::vector<std::uint32_t> own_voxels(const Points& points, float voxel_size, VoxelIndex& index) {
    MapPoints in_map;
    to_voxels(points, voxel_size, in_map);
    std::vector<bool> met(index.size());
    std::vector<std::uint32_t> ids;
    for (const VoxelKey key : in_map.keys) {
        if (key == kNoKey) continue;
        const std::uint32_t id = index.insert(key);
        if (id >= met.size()) met.resize(2 * id + 1);
        if (met[id]) continue;
        met[id] = true;
        ids.push_back(id);
    }
    std::sort(ids.begin(), ids.end());
    return ids;
}

ImageGrid sphere(const BackEndConfig& config, const BeamPattern& beams) {
    // Pixels have the same size in both directions: from another pose, the beams no longer form a
    // regular grid.
    const float spacing = std::max(beams.azimuth_spacing, beams.elevation_spacing);
    const float step = pixel_step(config.image_step_deg, config.image_step_beams, spacing);
    constexpr float kPole = 0.5F * std::numbers::pi_v<float>;
    return make_grid(step, step, -kPole, kPole);
}

}  // namespace

void BackEnd::insert(Submap submap, const BeamPattern& beams, StageTimes& times) {
    grid_ = sphere(config_, beams);
    BufferedSubmap buffered{.submap = std::move(submap)};
    timed(times, "voxelization",
          [&] { buffered.voxels = own_voxels(buffered.submap.points, voxel_size_, voxels_); });
    slot_of_voxel_.resize(voxels_.size(), 0);
    if (config_.enabled && config_.incident_correction) {
        timed(times, "normals",
              [&] { buffered.normals = estimate_normals(buffered.submap.points, voxel_size_); });
    }
    buffer_.push_back(std::move(buffered));
}

double BackEnd::keep_within(const Eigen::Vector3d& center, double radius, std::size_t most_points) {
    const auto distance = [&](const BufferedSubmap& b) {
        return (b.submap.T_map_submap.translation() - center).norm();
    };
    std::erase_if(buffer_, [&](const BufferedSubmap& b) { return distance(b) > radius; });
    while (buffer_.size() > 1 && points() > most_points) {
        const auto farthest = std::max_element(
            buffer_.begin(), buffer_.end(),
            [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
        radius = distance(*farthest);
        buffer_.erase(farthest);
    }
    voxels_ = {};
    for (BufferedSubmap& b : buffer_) {
        b.voxels = own_voxels(b.submap.points, voxel_size_, voxels_);
    }
    slot_of_voxel_.assign(voxels_.size(), 0);
    return radius;
}

std::size_t BackEnd::points() const {
    std::size_t sum = 0;
    for (const BufferedSubmap& b : buffer_) sum += b.submap.points.size();
    return sum;
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
         search_radius(buffer_, T_map_query.translation(), search_radius_,
                       static_cast<std::size_t>(config_.max_submaps), anchor)) {
        nearby.push_back(&buffer_[i]);
    }
    const auto boundaries = timed(times, "visibility_check", [&] {
        return check_visibility(nearby, T_map_query, grid_, config_);
    });
    return timed(times, "occupancy", [&] {
        return occupancy(count_owners(nearby, slot_of_voxel_), boundaries, voxels_, voxel_size_,
                         T_map_query, grid_, config_);
    });
}

}  // namespace dynamic_filter
