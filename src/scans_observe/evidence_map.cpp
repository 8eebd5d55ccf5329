// SPDX-License-Identifier: MIT
#include "dynamic_filter/scans_observe/evidence_map.hpp"

#include <algorithm>
#include <utility>

#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter {

namespace {

constexpr std::size_t kGrain = 64;  // blocks that a thread takes at a time

}  // namespace

EvidenceMap::EvidenceMap(const Config& config)
    : margins_(margins_of(config.scans.sight, config.map.voxel_size)),
      grid_(static_cast<float>(config.map.voxel_size), config.scans.evidence),
      observers_(config) {}

PointVoxels EvidenceMap::insert(const Scan& scan, StageTimes& times) {
    is_due_ = false;
    if (std::none_of(scan.points.begin(), scan.points.end(), is_measured)) {
        return PointVoxels(scan.points.size(), kNoVoxel);
    }
    known_ = grid_.size();
    PointVoxels voxels_of_points;
    timed(times, "insertion", [&] {  // of the points, and beside it of the beams
        parallel_for(2, 1, [&](std::size_t begin, std::size_t end) {
            if (begin == 0) voxels_of_points = grid_.add_points(scan);
            if (end == 2) is_due_ = observers_.add(scan);
        });
    });
    indices_.push_back(scan.index);
    timed(times, "visibility_check", [&] {
        if (is_due_) check_known(grid_.blocks_touched(true));
        check_new();
    });
    return voxels_of_points;
}

void EvidenceMap::observe_elsewhere(StageTimes& times) {
    if (!std::exchange(is_due_, false) || known_ == 0) return;
    timed(times, "visibility_check_elsewhere", [&] { check_known(grid_.blocks_touched(false)); });
}

/// Some voxels of some blocks, and room for what an observer sees there.
struct EvidenceMap::Batch {
    std::uint32_t first = 0, end = 0;        // those of these numbers ...
    std::span<const std::uint32_t> place{};  // ... and, if this is not empty, with a place here
    Points centers{};
    std::vector<std::uint32_t> voxels{};
    Points centroids{};
    Directions seen{};
    std::vector<Sight> sights{};
};

/// The newest observer checks the voxels that were known before its scan.
void EvidenceMap::check_known(std::span<const std::uint32_t> blocks) {
    parallel_for(blocks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        Batch batch{.first = 0, .end = known_};
        observe(blocks.subspan(begin, end - begin), batch, {&observers_.kept().back(), 1}, true);
        for (std::size_t i = 0; i < batch.voxels.size(); ++i) {
            if (batch.sights[i] != Sight::unknown) grid_.update_score(batch.voxels[i]);
        }
    });
}

/// The voxels that the newest scan has added ask the observers.
void EvidenceMap::check_new() {
    const std::vector<std::uint32_t> blocks = grid_.blocks_from(known_);
    const std::vector<Observers::Asked> asked = observers_.asked_by_new();
    parallel_for(blocks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        Batch batch{.first = known_, .end = grid_.size()};
        for (const Observers::Asked& one : asked) {
            const bool newest = is_due_ && one.observer == &observers_.kept().back();
            observe({&blocks[begin], end - begin}, batch, one, newest);
        }
        for (std::size_t b = begin; b < end; ++b) {
            grid_.voxels().each_in_block(blocks[b], [&](std::uint32_t v) {
                if (v >= batch.first) grid_.update_score(v);
            });
        }
    });
}

/// Fills `batch` with the voxels that may be within sight, and what the observer sees there.
void EvidenceMap::find_sights(std::span<const std::uint32_t> blocks, Batch& batch,
                              const Observer& observer) const {
    SightMargins margins = margins_;
    margins.farthest = observer.reach;
    const float radius = 3.5F * grid_.voxel_size();  // of the sphere around a block, and a little
    batch.centers.clear();
    for (const std::uint32_t block : blocks) batch.centers.push_back(grid_.middle_of(block));
    to_spherical(batch.centers, observer.T_sensor_map, batch.seen);
    batch.voxels.clear();
    batch.centroids.clear();
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const Beam center{batch.seen.azimuth[b], batch.seen.elevation[b], batch.seen.range[b]};
        if (!may_see(observer.image, center, radius, margins)) continue;
        grid_.voxels().each_in_block(blocks[b], [&](std::uint32_t v) {
            const bool is_asked = batch.place.empty() || batch.place[v] != kNoVoxel;
            if (v >= batch.first && v < batch.end && is_asked) batch.voxels.push_back(v);
        });
    }
    for (std::size_t i = 0; i < batch.voxels.size(); ++i) {
        constexpr std::size_t kAhead = 12;  // voxels of a block lie far apart in memory
        if (i + kAhead < batch.voxels.size()) {
            __builtin_prefetch(&grid_[batch.voxels[i + kAhead]]);
        }
        batch.centroids.push_back(grid_[batch.voxels[i]].centroid);
    }
    to_spherical(batch.centroids, observer.T_sensor_map, batch.seen);
    check_lines_of_sight(observer.image, batch.seen, margins, batch.sights);
}

void EvidenceMap::observe(std::span<const std::uint32_t> blocks, Batch& batch,
                          const Observers::Asked& asked, bool newest) {
    find_sights(blocks, batch, *asked.observer);
    for (std::size_t i = 0; i < batch.voxels.size(); ++i) {
        if (batch.sights[i] == Sight::unknown) continue;
        grid_.record(batch.voxels[i], batch.sights[i], asked.weight, newest);
    }
}

std::vector<std::vector<std::size_t>> EvidenceMap::free_keyframes(
    std::span<const std::uint32_t> voxels) const {
    std::vector<std::uint32_t> place(grid_.size(), kNoVoxel), blocks;  // place among `voxels`
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        place[voxels[i]] = static_cast<std::uint32_t>(i);
        blocks.push_back(grid_.voxels().block_of_voxel(voxels[i]));
    }
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    constexpr std::size_t kMostAsked = 64;
    const auto& kept = observers_.kept();
    const std::size_t stride = (kept.size() + kMostAsked - 1) / kMostAsked;
    std::vector<std::vector<std::size_t>> result(voxels.size());
    if (kept.empty()) return result;
    parallel_for(blocks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        Batch batch{.first = 0, .end = grid_.size(), .place = place};
        for (std::size_t k = stride - 1; k < kept.size(); k += stride) {
            const Observer& observer = kept[k];
            find_sights({&blocks[begin], end - begin}, batch, observer);
            for (std::size_t i = 0; i < batch.voxels.size(); ++i) {
                if (is_free(batch.sights[i])) {
                    result[place[batch.voxels[i]]].push_back(observer.index);
                }
            }
        }
    });
    return result;
}

}  // namespace dynamic_filter
