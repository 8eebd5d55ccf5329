// SPDX-License-Identifier: MIT
#include "dynamic_filter/back_end/evidence_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "best_kernel.hpp"
#include "dynamic_filter/front_end/submap.hpp"
#include "dynamic_filter/front_end/window.hpp"
#include "dynamic_filter/parallel.hpp"
#include "vote_kernel.hpp"

namespace dynamic_filter {

namespace {

Observer make_observer(const Scan& scan, const BeamPattern& beams) {
    return {BeamImage(scan.points, beams), scan.T_world_sensor.inverse().cast<float>()};
}

/// A few points say nothing about how densely the sensor looks.
bool is_reliable(const BeamPattern& beams, const Scan& scan) {
    constexpr std::size_t kEnough = 1000;
    return beams.azimuth_spacing > 0.0F && beams.elevation_spacing > 0.0F &&
           scan.points.size() >= kEnough;
}

/// A voxel blurs by its size what a place is.
SightMargins margins_for(float voxel_size) {
    SightMargins margins;
    margins.touch = std::max(margins.touch, 0.75F * voxel_size);
    margins.surface = std::max(margins.surface, 0.5F * voxel_size);
    margins.beyond = std::max(margins.beyond, voxel_size);
    return margins;
}

}  // namespace

EvidenceMap::EvidenceMap(const Config& config)
    : voxel_size_(static_cast<float>(config.back_end.voxel_size)),
      keyframes_(config.submap),
      most_observers_(static_cast<std::size_t>(config.back_end.max_scans)),
      margins_(margins_for(voxel_size_)) {}

PointVoxels EvidenceMap::insert(const Scan& scan, StageTimes& times) {
    if (std::none_of(scan.points.begin(), scan.points.end(), is_measured)) {
        return PointVoxels(scan.points.size(), kNoVoxel);
    }
    const std::size_t known = voxels_.size();
    PointVoxels voxels_of_points;
    const bool observes = timed(times, "front_end", [&] {
        timed(times, "voxelization", [&] { voxels_of_points = add_points(scan); });
        return timed(times, "beam_image", [&] { return add_observer(scan); });
    });
    timed(times, "back_end", [&] {
        if (observes) timed(times, "visibility_check", [&] { check_known(known); });
        timed(times, "visibility_check_of_new", [&] { check_new(known); });
    });
    ++scans_;
    return voxels_of_points;
}

bool EvidenceMap::add_observer(const Scan& scan) {
    if (last_keyframe_ && !is_keyframe(*last_keyframe_, scan, keyframes_)) return false;
    const BeamPattern beams = beams_ ? *beams_ : estimate_beam_pattern({&scan, 1});
    if (!beams_ && is_reliable(beams, scan)) beams_ = beams;
    last_keyframe_ = Scan{{}, scan.T_world_sensor, scan.stamp, scan.index};
    observers_.push_back(make_observer(scan, beams));
    ++all_observers_;
    if (observers_.size() > most_observers_) observers_.pop_front();
    return true;
}

/// Whom to look at, and room to do so.
struct EvidenceMap::Glance {
    std::uint32_t first = 0, end = 0;  // voxels
    Points centers{};
    std::vector<std::uint32_t> voxels{};
    Points centroids{};
    Directions seen{};
    std::vector<Sight> sights{};
};

/// The newest observer looks at the voxels known before it.
void EvidenceMap::check_known(std::size_t known) {
    constexpr std::size_t kGrain = 64;  // blocks
    std::vector<std::uint32_t> blocks(voxels_.blocks());
    std::iota(blocks.begin(), blocks.end(), 0U);
    parallel_for(blocks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        Glance glance{.first = 0, .end = static_cast<std::uint32_t>(known)};
        look_at({&blocks[begin], end - begin}, glance, observers_.back());
    });
}

/// New voxels ask all observers, oldest first.
void EvidenceMap::check_new(std::size_t known) {
    std::vector<std::uint32_t> blocks;
    for (std::size_t v = known; v < voxels_.size(); ++v) {
        const std::uint32_t block = voxels_.block_of_voxel(static_cast<std::uint32_t>(v));
        if (blocks.empty() || blocks.back() != block) blocks.push_back(block);
    }
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    constexpr std::size_t kGrain = 64;  // blocks
    parallel_for(blocks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        Glance glance{.first = static_cast<std::uint32_t>(known),
                      .end = static_cast<std::uint32_t>(voxels_.size())};
        for (const Observer& observer : observers_) {
            look_at({&blocks[begin], end - begin}, glance, observer);
        }
    });
}

void EvidenceMap::look_at(std::span<const std::uint32_t> blocks, Glance& glance,
                          const Observer& observer) {
    const float radius = 3.5F * voxel_size_;  // of the sphere around a block, and a little
    glance.centers.clear();
    for (const std::uint32_t block : blocks) {
        glance.centers.push_back((voxels_.corner(block).cast<float>().array() + 2.0F) *
                                 voxel_size_);
    }
    to_spherical(glance.centers, observer.T_sensor_map, glance.seen);
    glance.voxels.clear();
    glance.centroids.clear();
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const Beam center{glance.seen.azimuth[b], glance.seen.elevation[b], glance.seen.range[b]};
        if (!may_see(observer.image, center, radius, margins_)) continue;
        voxels_.each_in_block(blocks[b], [&](std::uint32_t v) {
            if (v < glance.first || v >= glance.end) return;
            glance.voxels.push_back(v);
            glance.centroids.push_back(centroids_[v]);
        });
    }
    to_spherical(glance.centroids, observer.T_sensor_map, glance.seen);
    look(observer.image, glance.seen, margins_, glance.sights);
    for (std::size_t i = 0; i < glance.voxels.size(); ++i) {
        if (glance.sights[i] == Sight::nothing) continue;
        Evidence& evidence = evidence_[glance.voxels[i]];
        record(evidence, glance.sights[i]);
        transience_[glance.voxels[i]] = transience(evidence);
    }
}

PointVoxels EvidenceMap::add_points(const Scan& scan) {
    Points points;
    PointVoxels voxels_of_points(scan.points.size(), kNoVoxel);
    to_map(scan, points);
    const std::size_t known = voxels_.size();
    std::vector<std::uint32_t> counts;  // points of the new voxels
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!is_measured(scan.points[i])) continue;
        const auto key = voxel_of(points[i], voxel_size_);
        if (!key) continue;
        const std::uint32_t voxel = voxels_.insert(*key);
        voxels_of_points[i] = voxel;
        if (voxel == evidence_.size()) {
            evidence_.push_back({.first_owner = scans_});
            transience_.push_back(0.0F);
            centroids_.emplace_back(Point::Zero());
            counts.push_back(0);
        }
        if (voxel >= known) {  // sums from the voxel's centre, so that floats lose nothing
            centroids_[voxel] += points[i] - center(*key, voxel_size_);
            ++counts[voxel - known];
        }
        Evidence& e = evidence_[voxel];
        if (e.owned == 0 || e.last_owner != scans_) {
            e.last_owner = scans_;
            if (e.owned < UINT16_MAX) ++e.owned;
            transience_[voxel] = transience(e);
        }
    }
    for (std::size_t v = known; v < voxels_.size(); ++v) {
        const auto voxel = static_cast<std::uint32_t>(v);
        centroids_[v] = center(voxels_.key(voxel), voxel_size_) +
                        centroids_[v] / static_cast<float>(counts[v - known]);
    }
    return voxels_of_points;
}

/// Those who may vote on the voxels of a block.
struct EvidenceMap::Neighborhood {
    static constexpr std::size_t kMost = 8 * 8 * 8;  // a block, and two cells around it
    using Column = std::array<float, kMost>;
    Column x, y, z, opinion, first, last;
    std::size_t count = 0;

    void add(const Cell& cell, float voter_opinion, const Evidence& e) {
        x[count] = static_cast<float>(cell.x());
        y[count] = static_cast<float>(cell.y());
        z[count] = static_cast<float>(cell.z());
        opinion[count] = voter_opinion;
        first[count] = static_cast<float>(e.first_owner);
        last[count] = static_cast<float>(e.last_owner);
        ++count;
    }
    void gather(const EvidenceMap& map, std::uint32_t block) {
        count = 0;
        const Cell corner = map.voxels_.corner(block);
        map.voxels_.each_in_box(corner.array() - 2, corner.array() + 5,
                                [&](std::uint32_t v, const Cell& cell) {
                                    add(cell, map.transience_[v], map.evidence_[v]);
                                });
        constexpr auto kAway = static_cast<int>(kernel::kOutOfReach);
        while (count % kernel::kVoters != 0) add(Cell::Constant(kAway), 0.0F, {});
    }
    /// Things come and go as a whole, so the voxels that were there together know most of each
    /// other. Surfaces go on and people walk where others did, so the rest of the neighbourhood
    /// knows, too. Within +-3.
    [[nodiscard]] float vote_on(const Cell& cell, const Evidence& e) const {
        static const auto kernel = DYNAMIC_FILTER_BEST_KERNEL(vote);
        return kernel({x.data(), y.data(), z.data(), opinion.data(), first.data(), last.data(),
                       count, static_cast<float>(cell.x()), static_cast<float>(cell.y()),
                       static_cast<float>(cell.z()), static_cast<float>(e.first_owner),
                       static_cast<float>(e.last_owner)});
    }
};

/// The sum of the three opinions lies within +-4, below 0: static. By the simulated and the real
/// recordings, its log-odds are three to five times as much.
std::vector<std::optional<float>> EvidenceMap::probabilities(
    std::span<const std::uint32_t> voxels) const {
    std::vector<std::pair<std::uint32_t, std::size_t>> by_block;  // block, place among `voxels`
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (is_unknown(evidence_[voxels[i]])) continue;
        by_block.emplace_back(voxels_.block_of_voxel(voxels[i]), i);
    }
    std::sort(by_block.begin(), by_block.end());
    std::vector<std::optional<float>> result(voxels.size());
    constexpr std::size_t kGrain = 512;
    parallel_for(by_block.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        Neighborhood neighborhood;
        for (std::size_t i = begin; i < end; ++i) {
            const auto [block, at] = by_block[i];
            if (i == begin || by_block[i - 1].first != block) neighborhood.gather(*this, block);
            const std::uint32_t v = voxels[at];
            const float vote = neighborhood.vote_on(unpack(voxels_.key(v)), evidence_[v]);
            result[at] = 1.0F / (1.0F + std::exp(3.0F * (transience_[v] + vote)));
        }
    });
    return result;
}

}  // namespace dynamic_filter
