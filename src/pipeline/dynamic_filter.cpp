// SPDX-License-Identifier: MIT
#include "dynamic_filter/pipeline/dynamic_filter.hpp"

#include <limits>
#include <numeric>
#include <utility>

#include "dynamic_filter/geometry/pose.hpp"
#include "dynamic_filter/parallel.hpp"

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
    : config_(checked(config)),
      cutter_(config_.submap),
      front_end_(config_),
      back_end_(config_),
      evidence_(config_) {}

bool DynamicFilter::scans_observe() const {
    return config_.back_end.enabled && config_.back_end.observers == Observers::scans;
}

Pose DynamicFilter::to_map_frame(const Pose& T_world_sensor) const {
    Pose shifted = T_world_sensor;
    shifted.translation() -= *origin_;
    return shifted;
}

std::size_t DynamicFilter::submaps() const {
    const auto keyframes = static_cast<std::size_t>(config_.submap.keyframes);
    return scans_observe() ? (evidence_.observers() + keyframes - 1) / keyframes
                           : back_end_.buffer().size();
}

std::vector<Verdict> DynamicFilter::push(Scan scan) {
    if (!origin_) origin_ = nearby_origin(scan.T_world_sensor, config_.back_end.voxel_size);
    scan.T_world_sensor = to_map_frame(scan.T_world_sensor);
    if (scans_observe()) {
        const PointVoxels voxels = evidence_.insert(scan, times_);
        return {timed(times_, "front_end", [&] {
            return timed(times_, "instant_verdict",
                         [&] { return instant_verdict(scan.index, voxels); });
        })};
    }
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
    if (scans_observe()) {
        timed(times_, "back_end", [&] { timed(times_, "merging", [&] { decide_voxels(); }); });
        return {};
    }
    std::vector<Verdict> instant;
    if (const auto window = cutter_.flush()) instant = process(*window);
    if (config_.back_end.enabled) merge_local_maps();
    return instant;
}

void DynamicFilter::decide_voxels() {
    std::vector<std::uint32_t> all(evidence_.voxels().size());
    std::iota(all.begin(), all.end(), 0U);
    const auto probabilities = evidence_.probabilities(all);
    decided_.resize(all.size());
    for (std::size_t v = 0; v < all.size(); ++v) decided_[v].probability = probabilities[v];
    parallel_for(all.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) decided_[v].contact = contact_of(all[v]);
    });
}

std::optional<Surface> DynamicFilter::contact_of(std::uint32_t voxel) const {
    if (label_of(decided_[voxel].probability) != Label::still) return std::nullopt;
    const auto each_within = [&](int cells, const auto& use) {
        voxels().each_within(cells, voxels().key(voxel), use);
    };
    bool touches_dynamic = false;
    each_within(1, [&](std::uint32_t v, int) {
        touches_dynamic |= label_of(decided_[v].probability) == Label::dynamic;
    });
    if (!touches_dynamic) return std::nullopt;
    std::vector<VoxelVerdict> around;
    each_within(2, [&](std::uint32_t v, int distance) {
        around.push_back({evidence_.centroid(v), label_of(decided_[v].probability), distance});
    });
    return contact_surface(around);
}

void DynamicFilter::merge_local_maps() {
    for (std::size_t i = 0; i < back_end_.buffer().size(); ++i) {
        timed(times_, "back_end", [&] {
            const LocalMap local = back_end_.local_map_of(i, times_);
            timed(times_, "merging", [&] {
                merge(merged_, local, back_end_.buffer()[i].submap.T_map_submap, back_end_.voxels(),
                      config_.back_end.voxel_size);
            });
        });
    }
}

Label DynamicFilter::label_of(std::optional<float> probability) const {
    if (!probability) return Label::unknown;
    const auto threshold = static_cast<float>(config_.back_end.occupancy_threshold);
    return *probability >= threshold ? Label::still : Label::dynamic;
}

Label DynamicFilter::label_by_submaps(const Point& map_point, float& probability) const {
    const auto key = voxel_of(map_point, static_cast<float>(config_.back_end.voxel_size));
    if (!key) return Label::unknown;
    const auto voxel = voxels().find(*key);
    if (!voxel) return Label::dynamic;  // no static submap holds it: the front-end removed it all
    if (!config_.back_end.enabled) {
        probability = 1.0F;
        return Label::still;
    }
    if (*voxel >= merged_.probability.size()) return Label::unknown;  // before finish()
    probability = merged_.probability[*voxel];
    return label_of(std::optional(probability));
}

/// From the evidence so far. Every voxel is judged once, however many points it holds.
Verdict DynamicFilter::instant_verdict(std::size_t index, const PointVoxels& voxels) const {
    std::vector<std::uint32_t> own;
    std::vector<Label> labels(evidence_.voxels().size(), Label::unknown);
    constexpr auto kMet = Label::still;  // until it is judged
    for (const std::uint32_t voxel : voxels) {
        if (voxel == kNoVoxel || labels[voxel] == kMet) continue;
        labels[voxel] = kMet;
        own.push_back(voxel);
    }
    const auto probabilities = evidence_.probabilities(own);
    for (std::size_t v = 0; v < own.size(); ++v) labels[own[v]] = label_of(probabilities[v]);
    Verdict verdict{index, Labels(voxels.size(), Label::unknown), {}};
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (voxels[i] != kNoVoxel) verdict.labels[i] = labels[voxels[i]];
    }
    return verdict;
}

std::vector<StaticVoxel> DynamicFilter::local_static_map(const Pose& T_world_query) {
    std::vector<StaticVoxel> result;
    if (!origin_) return result;
    const auto size = static_cast<float>(config_.back_end.voxel_size);
    const auto add = [&](std::uint32_t voxel, float probability) {
        const Point at = center(voxels().key(voxel), size);
        result.push_back({*origin_ + at.cast<double>(), probability});
    };
    const Pose T_map_query = to_map_frame(T_world_query);
    if (scans_observe()) {
        const Point position = T_map_query.translation().cast<float>();
        const auto radius = static_cast<float>(config_.back_end.search_radius);
        std::vector<std::uint32_t> near;
        for (std::uint32_t v = 0; v < evidence_.voxels().size(); ++v) {
            if ((evidence_.centroid(v) - position).norm() <= radius) near.push_back(v);
        }
        const auto probabilities = evidence_.probabilities(near);
        for (std::size_t i = 0; i < near.size(); ++i) {
            if (label_of(probabilities[i]) == Label::still) add(near[i], *probabilities[i]);
        }
        return result;
    }
    const LocalMap local = back_end_.local_map(T_map_query, times_);
    for (std::size_t i = 0; i < local.voxels.size(); ++i) {
        if (label_of(std::optional(local.probability[i])) == Label::still) {
            add(local.voxels[i], local.probability[i]);
        }
    }
    return result;
}

Verdict DynamicFilter::verdict(const Scan& scan) const {
    Points points;
    to_map(scan.points, to_map_frame(scan.T_world_sensor), points);
    Verdict verdict{scan.index, Labels(points.size(), Label::unknown),
                    std::vector<float>(points.size(), 0.0F)};
    if (scans_observe()) {
        judge_by_scans(scan.points, points, verdict);
        return verdict;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!is_measured(scan.points[i])) continue;
        verdict.labels[i] = label_by_submaps(points[i], verdict.probability[i]);
    }
    return verdict;
}

void DynamicFilter::judge_by_scans(const Points& sensor_points, const Points& map_points,
                                   Verdict& verdict) const {
    const auto size = static_cast<float>(config_.back_end.voxel_size);
    VoxelFinder find(voxels());
    PointVoxels voxels(map_points.size(), kNoVoxel);
    for (std::size_t i = 0; i < map_points.size(); ++i) {
        if (!is_measured(sensor_points[i])) continue;
        const auto key = voxel_of(map_points[i], size);
        const std::uint32_t voxel = key ? find(*key) : kNoVoxel;
        if (voxel >= decided_.size()) continue;  // not there, or before finish()
        voxels[i] = voxel;
        verdict.labels[i] = label_of(decided_[voxel].probability);
        verdict.probability[i] = decided_[voxel].probability.value_or(0.0F);
    }
    judge_contacts(map_points, voxels, verdict.labels);
}

/// A static point becomes dynamic if it lies above the static surface of its voxel while, in this
/// very scan, something dynamic touches the voxel.
void DynamicFilter::judge_contacts(const Points& map_points, const PointVoxels& voxels,
                                   Labels& labels) const {
    std::vector<bool> moving(decided_.size());  // dynamic voxels with a point in this scan
    std::vector<std::size_t> above;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] == Label::dynamic) moving[voxels[i]] = true;
        if (labels[i] != Label::still) continue;
        const auto& contact = decided_[voxels[i]].contact;
        if (contact && contact->height(map_points[i]) > kContactHeight) above.push_back(i);
    }
    for (const std::size_t i : above) {
        bool touches = false;
        evidence_.voxels().each_within(1, evidence_.voxels().key(voxels[i]),
                                       [&](std::uint32_t v, int) { touches |= moving[v]; });
        if (touches) labels[i] = Label::dynamic;
    }
}

}  // namespace dynamic_filter
