// SPDX-License-Identifier: MIT
#include "paper/pipeline.hpp"

#include <limits>
#include <memory>
#include <utility>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter {

namespace {

Config as_variant(Config config) {
    validate(config);
    if (config.method == Method::removert) {
        config.submap.keyframes = std::numeric_limits<int>::max();
        config.back_end.enabled = false;
    }
    return config;
}

}  // namespace

PaperPipeline::PaperPipeline(const Config& config, Horizon horizon)
    : config_(as_variant(config)),
      frame_{.voxel_size = config.map.voxel_size},
      cutter_(config_.keyframe, config_.submap.keyframes),
      front_end_(config_),
      back_end_(config_),
      horizon_(horizon) {}

std::vector<Verdict> PaperPipeline::push(Scan scan) {
    if (finished_) throw Error("push() after finish(): make another filter");
    frame_.begin(scan.T_world_sensor);
    scan.T_world_sensor = frame_.to_map(scan.T_world_sensor);
    const Eigen::Vector3d here = scan.T_world_sensor.translation();
    const auto window = cutter_.push(std::move(scan));
    if (!window) return {};
    std::vector<Verdict> verdicts = process(*window);
    back_thread_.add([this, here] { forget_far_from(here); });
    return verdicts;
}

/// The front-end makes a submap of the window, and leaves it to the back-end.
std::vector<Verdict> PaperPipeline::process(const Window& window) {
    auto [submap, labels] =
        timed(front_times_, "front_end", [&] { return front_end_.process(window, front_times_); });
    const auto on_its_way = std::make_shared<Submap>(std::move(submap));
    back_thread_.add([this, on_its_way, beams = *front_end_.beams()] {
        timed(back_times_, "back_end",
              [&] { back_end_.insert(std::move(*on_its_way), beams, back_times_); });
    });
    std::vector<Verdict> verdicts;
    for (std::size_t s = 0; s < window.scans.size(); ++s) {
        verdicts.push_back({window.scans[s].index, std::move(labels[s]), {}});
    }
    return verdicts;
}

void PaperPipeline::forget_far_from(const Eigen::Vector3d& here) {
    const auto cut = horizon_.due(here, back_end_.points());
    if (!cut) return;
    const double reach = back_end_.keep_within(here, cut->radius, cut->most);
    kept_ = Kept{here.cast<float>(), static_cast<float>(reach)};
}

/// The local map at the pose of every submap is computed; together they are the map.
std::vector<Verdict> PaperPipeline::finish() {
    if (std::exchange(finished_, true)) return {};
    std::vector<Verdict> instant;
    if (const auto window = cutter_.flush()) instant = process(*window);
    flush();
    if (config_.back_end.enabled) merge_local_maps();
    return instant;
}

void PaperPipeline::merge_local_maps() {
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

bool PaperPipeline::is_forgotten(const Point& at) const {
    return kept_ && (at - kept_->center).norm() > kept_->radius;
}

/// A voxel that no static submap holds was removed by the front-end, so it is dynamic.
std::optional<float> PaperPipeline::decision_on(std::uint32_t voxel, const Point& at) const {
    if (voxel == kNoVoxel) return is_forgotten(at) ? std::nullopt : std::optional(0.0F);
    if (!config_.back_end.enabled) return 1.0F;
    if (voxel >= merged_.probability.size()) return std::nullopt;
    return merged_.probability[voxel];
}

Verdict PaperPipeline::verdict(const Scan& scan) const {
    Verdict verdict = unknown_verdict(scan);
    if (!finished_) return verdict;
    const LocatedScan located = frame_.locate(scan, back_end_.voxels());
    for (std::size_t i = 0; i < located.voxels.size(); ++i) {
        if (located.in_map.keys[i] == kNoKey) continue;
        const auto probability = decision_on(located.voxels[i], located.in_map.points[i]);
        verdict.labels[i] = located.voxels[i] == kNoVoxel && probability
                                ? Label::dynamic
                                : label_of(probability, config_.map.occupancy_threshold);
        verdict.probability[i] = probability.value_or(0.0F);
    }
    return verdict;
}

std::vector<StaticVoxel> PaperPipeline::static_among(std::span<const VoxelOccupancy> voxels) const {
    std::vector<StaticVoxel> result;
    for (const auto& [voxel, probability] : voxels) {
        if (label_of(probability, config_.map.occupancy_threshold) != Label::static_) continue;
        result.push_back({frame_.center_of(back_end_.voxels().key(voxel)), probability, voxel});
    }
    return result;
}

std::vector<StaticVoxel> PaperPipeline::local_static_map(const Pose& T_world_query) {
    flush();
    if (!frame_.origin) return {};
    const LocalMap local = back_end_.local_map(frame_.to_map(T_world_query), back_times_);
    std::vector<VoxelOccupancy> voxels;
    for (std::size_t i = 0; i < local.voxels.size(); ++i) {
        voxels.push_back({local.voxels[i], local.probability[i]});
    }
    return static_among(voxels);
}

std::vector<StaticVoxel> PaperPipeline::static_map() const {
    if (!finished_) return {};
    std::vector<VoxelOccupancy> voxels;
    for (std::uint32_t v = 0; v < back_end_.voxels().size(); ++v) {
        if (const auto probability = decision_on(v, Point::Zero())) {
            voxels.push_back({v, *probability});
        }
    }
    return static_among(voxels);
}

PointVoxels PaperPipeline::voxels_of(const Scan& scan) const {
    return frame_.locate(scan, back_end_.voxels()).voxels;
}

std::vector<VoxelHistory> PaperPipeline::histories(std::span<const std::uint32_t> voxels) const {
    std::vector<VoxelHistory> histories(voxels.size());
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (voxels[i] >= merged_.probability.size()) continue;
        histories[i].probability = merged_.probability[voxels[i]];
    }
    return histories;
}

MapContents PaperPipeline::contents() const {
    const std::size_t submaps = back_end_.buffer().size();
    MapContents contents;
    contents.observer = "submaps";
    contents.observers = submaps;
    contents.voxels = back_end_.voxels().size();
    contents.beams = front_end_.beams();
    contents.throughput = {{"front_end", "scans", cutter_.scans()},
                           {"back_end", "submaps", submaps}};
    return contents;
}

StageTimes PaperPipeline::times() const {
    StageTimes all = front_times_;
    for (const auto& [stage, calls] : back_times_) all[stage].add(calls);
    return all;
}

}  // namespace dynamic_filter
