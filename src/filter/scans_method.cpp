// SPDX-License-Identifier: MIT
#include "filter/scans_method.hpp"

#include <algorithm>
#include <utility>

#include "filter/vote.hpp"

namespace dynamic_filter {

/// Judges a scan in these steps: its points go into voxels; if it is a keyframe, it observes the
/// voxels around its points; earlier keyframes observe the new voxels; each voxel of the scan gets
/// a verdict from its own evidence and that of its neighbors; tracked clusters are judged as a
/// whole. The observation of the rest of the map can wait.
Judged ScansMethod::judge(Scan scan) {
    return timed(times_, "judge", [&] {
        const PointVoxels voxels = evidence_.insert(scan, times_);
        Verdict verdict = timed(times_, "instant_verdict", [&] {
            return instant_.judge(scan.index, voxels, evidence_.grid());
        });
        timed(times_, "instances",
              [&] { instances_.update(scan, voxels, evidence_.grid(), verdict.labels); });
        Judged judged;
        judged.verdicts.push_back(std::move(verdict));
        judged.integrate = [this] {
            timed(times_, "integrate", [&] { evidence_.observe_elsewhere(times_); });
        };
        return judged;
    });
}

void ScansMethod::begin_drive() {
    evidence_.begin_drive();
    instances_ = Instances(config_.scans.instances);
}

void ScansMethod::look_again(std::size_t drive, const Scan& scan) {
    timed(times_, "look_again", [&] { evidence_.look_again(drive, scan); });
}

std::vector<Verdict> ScansMethod::finish() {
    timed(times_, "finish", [&] {
        decided_ = decide_voxels(evidence_.grid(), config_);
        if (config_.map.time == MapTime::latest) {
            occupied_since_ = occupied_since(decided_, evidence_.grid(), config_);
        }
    });
    return {};
}

void ScansMethod::decide(const LocatedScan& scan, Verdict& verdict) const {
    decide_points(scan, decided_, evidence_.grid(), config_, verdict);
    if (config_.map.time != MapTime::latest) return;
    verdict.stays.assign(scan.voxels.size(), false);
    for (std::size_t i = 0; i < scan.voxels.size(); ++i) {
        const std::uint32_t voxel = scan.voxels[i];
        if (voxel < decided_.size()) verdict.stays[i] = stays(voxel, verdict.index);
    }
}

/// True if the object in this voxel came, and is still there.
bool ScansMethod::stays(std::uint32_t voxel, std::size_t index) const {
    const auto since = occupied_since_[voxel];
    return since && index >= evidence_.index_of_owner(*since);
}

void ScansMethod::settle(const LocatedScan& scan, Verdict& verdict) const {
    PointVoxels own = scan.voxels;
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    if (!own.empty() && own.back() == kNoVoxel) own.pop_back();
    const auto occupancy = occupancy_of(evidence_.grid(), own, config_.scans);
    for (std::size_t i = 0; i < scan.voxels.size(); ++i) {
        if (scan.voxels[i] == kNoVoxel) continue;
        const auto at = std::lower_bound(own.begin(), own.end(), scan.voxels[i]) - own.begin();
        const auto& probability = occupancy[static_cast<std::size_t>(at)];
        verdict.labels[i] = label_of(probability, config_.map.occupancy_threshold);
        verdict.probability[i] = probability.value_or(0.0F);
    }
}

void ScansMethod::keep_within(const Eigen::Vector3d& center, double radius, std::size_t most) {
    const std::vector<std::uint32_t> kept =
        evidence_.keep_within(center.cast<float>(), static_cast<float>(radius), most);
    instant_.keep(kept);
    instances_.keep(kept);
}

std::vector<VoxelOccupancy> ScansMethod::local_map(const Pose& T_map_query,
                                                   std::optional<double> radius) {
    const auto reach = static_cast<float>(radius.value_or(config_.map.search_radius));
    const std::vector<std::uint32_t> near =
        evidence_.grid().within(T_map_query.translation().cast<float>(), reach);
    const auto occupancy = occupancy_of(evidence_.grid(), near, config_.scans);
    std::vector<VoxelOccupancy> result;
    for (std::size_t i = 0; i < near.size(); ++i) {
        if (label_of(occupancy[i], config_.map.occupancy_threshold) == Label::static_) {
            result.push_back({near[i], *occupancy[i]});
        }
    }
    return result;
}

std::vector<VoxelOccupancy> ScansMethod::static_map() const {
    std::vector<VoxelOccupancy> result;
    for (std::uint32_t v = 0; v < decided_.size(); ++v) {
        const auto& probability = decided_[v].probability;
        const bool is_there = v < occupied_since_.size() && occupied_since_[v];
        if (label_of(probability, config_.map.occupancy_threshold) == Label::static_) {
            result.push_back({v, *probability});
        } else if (is_there) {
            result.push_back({v, 1.0F});  // seen there until the end of the recording
        }
    }
    return result;
}

std::vector<VoxelHistory> ScansMethod::histories(std::span<const std::uint32_t> voxels) const {
    std::vector<VoxelHistory> histories(voxels.size());
    std::vector<std::uint32_t> seen_through;
    std::vector<std::size_t> at;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        const Evidence& e = evidence_.grid()[voxels[i]].evidence;
        histories[i] = {.probability = decided_[voxels[i]].probability,
                        .n_own = e.n_own,
                        .n_occ = e.n_occ,
                        .n_free = e.n_free,
                        .n_switch = e.n_switch,
                        .free = static_cast<float>(e.free) / kSure,
                        .expected_free = evidence_.grid().expected_free(e),
                        .score = evidence_.grid()[voxels[i]].score,
                        .first = evidence_.index_of_owner(e.first_owner),
                        .last = evidence_.index_of_owner(e.last_owner),
                        .free_keyframes = {}};
        // Not for voxels that stay in the map: they would need many keyframes and tell little.
        const bool was_removed =
            label_of(histories[i].probability, config_.map.occupancy_threshold) == Label::dynamic;
        if (e.n_free == 0 || !was_removed) continue;
        seen_through.push_back(voxels[i]);
        at.push_back(i);
    }
    auto keyframes = evidence_.free_keyframes(seen_through);
    for (std::size_t i = 0; i < at.size(); ++i) {
        histories[at[i]].free_keyframes = std::move(keyframes[i]);
    }
    return histories;
}

MapContents ScansMethod::contents() const {
    const Observers& observers = evidence_.observers();
    MapContents contents;
    contents.observer = "keyframes";
    contents.observers = observers.total();
    contents.beams = observers.beams();
    for (const Observer& observer : observers.kept()) contents.keyframes.push_back(observer.index);
    const std::size_t scans = evidence_.grid().scans();
    contents.throughput = {{"judge", "scans", scans}, {"integrate", "scans", scans}};
    return contents;
}

}  // namespace dynamic_filter
