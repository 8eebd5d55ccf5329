// SPDX-License-Identifier: MIT
#include "dynamic_filter/pipeline/dynamic_filter.hpp"

#include <limits>
#include <utility>

#include "dynamic_filter/geometry/pose.hpp"

namespace dynamic_filter {

namespace {

Config checked(const Config& config) {
    validate(config);
    Config result = config;
    if (config.method == Method::removert) {  // one window over the whole sequence, and no back-end
        result.submap.keyframes = std::numeric_limits<int>::max();
        result.front_end.enabled = true;
        result.back_end.enabled = false;
    }
    return result;
}

}  // namespace

DynamicFilter::DynamicFilter(const Config& config)
    : config_(checked(config)), cutter_(config_.submap), front_end_(config_), back_end_(config_) {}

Pose DynamicFilter::to_map_frame(const Pose& T_world_sensor) const {
    Pose shifted = T_world_sensor;
    shifted.translation() -= *origin_;
    return shifted;
}

std::vector<Verdict> DynamicFilter::push(Scan scan) {
    if (!origin_) origin_ = nearby_origin(scan.T_world_sensor, config_.back_end.voxel_size);
    scan.T_world_sensor = to_map_frame(scan.T_world_sensor);
    const auto window = cutter_.push(std::move(scan));
    return window ? process(*window) : std::vector<Verdict>{};
}

std::vector<Verdict> DynamicFilter::process(const Window& window) {
    auto [submap, labels] =
        timed(times_, "front_end", [&] { return front_end_.process(window, times_); });
    timed(times_, "back_end",
          [&] { back_end_.insert(std::move(submap), *front_end_.beams(), times_); });
    std::vector<Verdict> instant;
    for (std::size_t s = 0; s < window.scans.size(); ++s) {
        instant.push_back({window.scans[s].index, std::move(labels[s]), {}});
    }
    return instant;
}

std::vector<Verdict> DynamicFilter::finish() {
    std::vector<Verdict> instant;
    if (const auto window = cutter_.flush()) instant = process(*window);
    if (!config_.back_end.enabled) return instant;
    for (std::size_t i = 0; i < back_end_.buffer().size(); ++i) {
        timed(times_, "back_end", [&] {
            const LocalMap local = back_end_.local_map_of(i, times_);
            timed(times_, "merging", [&] {
                merge(merged_, local, back_end_.buffer()[i].submap.T_map_submap, back_end_.voxels(),
                      config_.back_end.voxel_size);
            });
        });
    }
    return instant;
}

Label DynamicFilter::label_of(const Point& map_point, float& probability) const {
    probability = 0.0F;
    const auto key = voxel_of(map_point, static_cast<float>(config_.back_end.voxel_size));
    if (!key) return Label::unknown;
    const auto voxel = back_end_.voxels().find(*key);
    if (!voxel) return Label::dynamic;  // no static submap holds it: the front-end removed it all
    if (!config_.back_end.enabled) {
        probability = 1.0F;
        return Label::still;
    }
    if (*voxel >= merged_.probability.size()) return Label::unknown;  // before finish()
    probability = merged_.probability[*voxel];
    const auto threshold = static_cast<float>(config_.back_end.occupancy_threshold);
    return probability >= threshold ? Label::still : Label::dynamic;
}

std::vector<StaticVoxel> DynamicFilter::local_static_map(const Pose& T_world_query) {
    std::vector<StaticVoxel> result;
    if (!origin_) return result;
    const LocalMap local = back_end_.local_map(to_map_frame(T_world_query), times_);
    const auto size = static_cast<float>(config_.back_end.voxel_size);
    for (std::size_t i = 0; i < local.voxels.size(); ++i) {
        if (local.probability[i] < static_cast<float>(config_.back_end.occupancy_threshold))
            continue;
        const Point at = center(back_end_.voxels().key(local.voxels[i]), size);
        result.push_back({*origin_ + at.cast<double>(), local.probability[i]});
    }
    return result;
}

Verdict DynamicFilter::verdict(const Scan& scan) const {
    Points points;
    to_map(scan.points, to_map_frame(scan.T_world_sensor), points);
    Verdict verdict{scan.index, Labels(points.size(), Label::unknown),
                    std::vector<float>(points.size(), 0.0F)};
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (is_measured(scan.points[i])) {
            verdict.labels[i] = label_of(points[i], verdict.probability[i]);
        }
    }
    return verdict;
}

}  // namespace dynamic_filter
