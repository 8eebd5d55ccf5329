// SPDX-License-Identifier: MIT
#include "paper/submaps_method.hpp"

#include <limits>
#include <memory>
#include <utility>

namespace dynamic_filter {

namespace {

Config as_variant(Config config) {
    if (config.method == Method::removert) {
        config.submap.keyframes = std::numeric_limits<int>::max();
        config.back_end.enabled = false;
    }
    return config;
}

}  // namespace

SubmapsMethod::SubmapsMethod(const Config& config)
    : config_(as_variant(config)),
      cutter_(config_.keyframe, config_.submap.keyframes),
      front_end_(config_),
      back_end_(config_) {}

/// Judges a scan (Fig. 2). As soon as a window is full, the front-end makes a submap of it; the
/// back-end adds the submap when it is free. finish() computes the local map at the pose of every
/// submap, and merges these maps.
Judged SubmapsMethod::judge(Scan scan) {
    const auto window = cutter_.push(std::move(scan));
    return window ? process(*window) : Judged{};
}

Judged SubmapsMethod::process(const Window& window) {
    auto [submap, labels] =
        timed(front_times_, "front_end", [&] { return front_end_.process(window, front_times_); });
    Judged judged;
    for (std::size_t s = 0; s < window.scans.size(); ++s) {
        judged.verdicts.push_back({window.scans[s].index, std::move(labels[s]), {}});
    }
    const auto on_its_way = std::make_shared<Submap>(std::move(submap));
    judged.integrate = [this, on_its_way, beams = *front_end_.beams()] {
        timed(back_times_, "back_end",
              [&] { back_end_.insert(std::move(*on_its_way), beams, back_times_); });
    };
    return judged;
}

std::vector<Verdict> SubmapsMethod::finish() {
    std::vector<Verdict> instant;
    if (const auto window = cutter_.flush()) {
        Judged judged = process(*window);
        judged.integrate();
        instant = std::move(judged.verdicts);
    }
    if (config_.back_end.enabled) merge_local_maps();
    return instant;
}

void SubmapsMethod::merge_local_maps() {
    for (std::size_t i = 0; i < back_end_.buffer().size(); ++i) {
        timed(back_times_, "back_end", [&] {
            const LocalMap local = back_end_.local_map_of(i, back_times_);
            timed(back_times_, "merging", [&] {
                merge(merged_, local, back_end_.buffer()[i].submap.T_map_submap, back_end_.voxels(),
                      config_.map.voxel_size);
            });
        });
    }
}

bool SubmapsMethod::is_forgotten(const Point& at) const {
    return kept_ && (at - kept_->center).norm() > kept_->radius;
}

/// A voxel that no static submap holds was removed by the front-end, so it is dynamic.
std::optional<float> SubmapsMethod::decision_on(std::uint32_t voxel, const Point& at) const {
    if (voxel == kNoVoxel) return is_forgotten(at) ? std::nullopt : std::optional(0.0F);
    if (!config_.back_end.enabled) return 1.0F;
    if (voxel >= merged_.probability.size()) return std::nullopt;
    return merged_.probability[voxel];
}

void SubmapsMethod::decide(const LocatedScan& scan, Verdict& verdict) const {
    for (std::size_t i = 0; i < scan.voxels.size(); ++i) {
        if (scan.in_map.keys[i] == kNoKey) continue;
        const auto probability = decision_on(scan.voxels[i], scan.in_map.points[i]);
        verdict.labels[i] = scan.voxels[i] == kNoVoxel && probability
                                ? Label::dynamic
                                : label_of(probability, config_.map.occupancy_threshold);
        verdict.probability[i] = probability.value_or(0.0F);
    }
}

void SubmapsMethod::keep_within(const Eigen::Vector3d& center, double radius, std::size_t most) {
    const double reach = back_end_.keep_within(center, radius, most);
    kept_ = {center.cast<float>(), static_cast<float>(reach)};
}

/// The submaps within `map.search_radius` decide; the given radius has no effect.
std::vector<VoxelOccupancy> SubmapsMethod::local_map(const Pose& T_map_query,
                                                     std::optional<double>) {
    const LocalMap local = back_end_.local_map(T_map_query, back_times_);
    std::vector<VoxelOccupancy> result;
    for (std::size_t i = 0; i < local.voxels.size(); ++i) {
        const float probability = local.probability[i];
        if (label_of(probability, config_.map.occupancy_threshold) == Label::static_) {
            result.push_back({local.voxels[i], probability});
        }
    }
    return result;
}

std::vector<VoxelOccupancy> SubmapsMethod::static_map() const {
    std::vector<VoxelOccupancy> result;
    for (std::uint32_t v = 0; v < voxels().size(); ++v) {
        const auto probability = decision_on(v, Point::Zero());
        if (label_of(probability, config_.map.occupancy_threshold) == Label::static_) {
            result.push_back({v, *probability});
        }
    }
    return result;
}

std::vector<VoxelHistory> SubmapsMethod::histories(std::span<const std::uint32_t> voxels) const {
    std::vector<VoxelHistory> histories(voxels.size());
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (voxels[i] >= merged_.probability.size()) continue;
        histories[i].probability = merged_.probability[voxels[i]];
    }
    return histories;
}

MapContents SubmapsMethod::contents() const {
    const std::size_t submaps = back_end_.buffer().size();
    MapContents contents;
    contents.observer = "submaps";
    contents.observers = submaps;
    contents.beams = front_end_.beams();
    contents.throughput = {{"front_end", "scans", cutter_.scans()},
                           {"back_end", "submaps", submaps}};
    return contents;
}

StageTimes SubmapsMethod::times() const {
    StageTimes all = front_times_;
    for (const auto& [stage, calls] : back_times_) all[stage].add(calls);
    return all;
}

}  // namespace dynamic_filter
