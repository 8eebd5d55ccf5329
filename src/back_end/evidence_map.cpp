// SPDX-License-Identifier: MIT
#include "dynamic_filter/back_end/evidence_map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "best_kernel.hpp"
#include "dynamic_filter/front_end/window.hpp"
#include "dynamic_filter/geometry/map_points.hpp"
#include "dynamic_filter/parallel.hpp"
#include "vote_kernel.hpp"

namespace dynamic_filter {

namespace {

Observer make_observer(const Scan& scan, const BeamPattern& beams, float reach) {
    return {BeamImage(scan.points, beams), scan.T_world_sensor.inverse().cast<float>(), reach,
            scan.index};
}

/// [m] A keyframe that is one because the sensor moved, soon after the last, looks no farther: it
/// shows what is near from another side, but what is far just as the last one did.
constexpr float kNearby = 40.0F;

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
    bool observes = false;
    timed(times, "voxelization", [&] {  // of the points, and beside it of the beams
        parallel_for(2, 1, [&](std::size_t begin, std::size_t end) {
            if (begin == 0) voxels_of_points = add_points(scan);
            if (end == 2) observes = add_observer(scan);
        });
    });
    timed(times, "visibility_check", [&] {
        if (observes) check_known(known, Where::touched);
        check_new(known);
    });
    rest_ = observes ? known : 0;
    ++scans_;
    indices_.push_back(scan.index);
    return voxels_of_points;
}

void EvidenceMap::look_at_rest(StageTimes& times) {
    if (rest_ == 0) return;
    timed(times, "visibility_check_of_rest", [&] { check_known(rest_, Where::elsewhere); });
    rest_ = 0;
}

bool EvidenceMap::add_observer(const Scan& scan) {
    if (last_keyframe_ && !is_keyframe(*last_keyframe_, scan, keyframes_)) return false;
    const BeamPattern beams = beams_ ? *beams_ : estimate_beam_pattern({&scan, 1});
    if (!beams_ && is_reliable(beams, scan)) beams_ = beams;
    last_keyframe_ = Scan{{}, scan.T_world_sensor, scan.stamp, scan.index};
    const bool after_a_while = scan.stamp - last_far_look_ >= keyframes_.keyframe_interval;
    const bool looks_far = all_observers_ == 0 || after_a_while;
    if (looks_far) last_far_look_ = scan.stamp;
    observers_.push_back(make_observer(
        scan, beams, looks_far ? margins_.farthest : std::min(kNearby, margins_.farthest)));
    ++all_observers_;
    if (observers_.size() > most_observers_) observers_.pop_front();
    return true;
}

/// Whom to look at, and room to do so.
struct EvidenceMap::Glance {
    std::uint32_t first = 0, end = 0;  // voxels
    unsigned weight = 1;
    Points centers{};
    std::vector<std::uint32_t> voxels{};
    Points centroids{};
    Directions seen{};
    std::vector<Sight> sights{};
};

/// The newest observer looks at the voxels known before it.
void EvidenceMap::check_known(std::size_t known, Where where) {
    constexpr std::size_t kGrain = 64;  // blocks
    const std::uint32_t now = where == Where::touched ? scans_ : scans_ - 1;
    std::vector<std::uint32_t> blocks;
    for (std::uint32_t b = 0; b < voxels_.blocks(); ++b) {
        if ((touched_[b] == now) == (where == Where::touched)) blocks.push_back(b);
    }
    parallel_for(blocks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        Glance glance{.first = 0, .end = static_cast<std::uint32_t>(known)};
        look_at({&blocks[begin], end - begin}, glance, observers_.back());
    });
}

/// Whom a new voxel asks, oldest first. Keyframes close in time see much the same, so it asks the
/// newest, as many as amount to 32 full images, and as many again of each time span that is twice
/// as long; they stand for those between them.
std::vector<EvidenceMap::Asked> EvidenceMap::asked_by_new() const {
    constexpr float kFullImages = 32.0F;
    std::vector<Asked> asked;
    if (observers_.empty()) return asked;
    const float coverage = std::max(observers_.back().image.coverage(), 0.01F);
    const auto all_of_newest = static_cast<std::size_t>(kFullImages / coverage);
    for (std::size_t i = 0; i < observers_.size(); ++i) {
        const std::size_t age = observers_.size() - 1 - i;
        const std::size_t apart = std::max<std::size_t>(1, std::bit_floor(age / all_of_newest));
        if ((all_observers_ - age) % apart == 0) {
            asked.push_back({&observers_[i], static_cast<unsigned>(apart)});
        }
    }
    return asked;
}

void EvidenceMap::check_new(std::size_t known) {
    std::vector<std::uint32_t> blocks;
    for (std::size_t v = known; v < voxels_.size(); ++v) {
        const std::uint32_t block = voxels_.block_of_voxel(static_cast<std::uint32_t>(v));
        if (blocks.empty() || blocks.back() != block) blocks.push_back(block);
    }
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    const std::vector<Asked> asked = asked_by_new();
    constexpr std::size_t kGrain = 64;  // blocks
    parallel_for(blocks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        Glance glance{.first = static_cast<std::uint32_t>(known),
                      .end = static_cast<std::uint32_t>(voxels_.size())};
        for (const auto& [observer, weight] : asked) {
            glance.weight = weight;
            look_at({&blocks[begin], end - begin}, glance, *observer);
        }
    });
}

Point EvidenceMap::middle_of(std::uint32_t block) const {
    return (voxels_.corner(block).cast<float>().array() + 2.0F) * voxel_size_;
}

/// Fills `glance` with the voxels that may be within sight, and what the observer sees there.
void EvidenceMap::see(std::span<const std::uint32_t> blocks, Glance& glance,
                      const Observer& observer) const {
    SightMargins margins = margins_;
    margins.farthest = observer.reach;
    const float radius = 3.5F * voxel_size_;  // of the sphere around a block, and a little
    glance.centers.clear();
    for (const std::uint32_t block : blocks) {
        glance.centers.push_back(middle_of(block));
    }
    to_spherical(glance.centers, observer.T_sensor_map, glance.seen);
    glance.voxels.clear();
    glance.centroids.clear();
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const Beam center{glance.seen.azimuth[b], glance.seen.elevation[b], glance.seen.range[b]};
        if (!may_see(observer.image, center, radius, margins)) continue;
        voxels_.each_in_block(blocks[b], [&](std::uint32_t v) {
            if (v >= glance.first && v < glance.end) glance.voxels.push_back(v);
        });
    }
    for (std::size_t i = 0; i < glance.voxels.size(); ++i) {
        constexpr std::size_t kAhead = 12;  // voxels of a block lie far apart in memory
        if (i + kAhead < glance.voxels.size()) {
            __builtin_prefetch(&states_[glance.voxels[i + kAhead]]);
        }
        glance.centroids.push_back(states_[glance.voxels[i]].centroid);
    }
    to_spherical(glance.centroids, observer.T_sensor_map, glance.seen);
    look(observer.image, glance.seen, margins, glance.sights);
}

void EvidenceMap::look_at(std::span<const std::uint32_t> blocks, Glance& glance,
                          const Observer& observer) {
    see(blocks, glance, observer);
    for (std::size_t i = 0; i < glance.voxels.size(); ++i) {
        if (glance.sights[i] == Sight::nothing) continue;
        State& state = states_[glance.voxels[i]];
        record(state.evidence, glance.sights[i], glance.weight);
        state.opinion = transience(state.evidence);
    }
}

/// The voxels of this scan met last. It comes back to them with every ring or column.
class EvidenceMap::OwnVoxels {
public:
    struct Entry {
        VoxelKey key = kNoKey;
        std::uint32_t voxel = kNoVoxel;
    };
    /// Where the voxel is, if it is here; the caller fills in what is not.
    Entry& at(VoxelKey key) { return entries_[VoxelHash{}(key) % entries_.size()]; }

private:
    std::vector<Entry> entries_ = std::vector<Entry>(4096);
};

PointVoxels EvidenceMap::add_points(const Scan& scan) {
    MapPoints in_map;
    to_voxels(scan.points, scan.T_world_sensor, voxel_size_, in_map);
    PointVoxels voxels_of_points(scan.points.size(), kNoVoxel);
    const std::size_t known = voxels_.size();
    OwnVoxels own_voxels;
    for (std::size_t i = 0; i < voxels_of_points.size(); ++i) {
        const VoxelKey key = in_map.keys[i];
        if (key == kNoKey) continue;
        OwnVoxels::Entry& entry = own_voxels.at(key);
        if (entry.key != key) entry = {key, own(key)};
        voxels_of_points[i] = entry.voxel;
    }
    number_by_block(known, voxels_of_points);
    find_centroids(known, in_map, voxels_of_points);
    return voxels_of_points;
}

/// Voxels that were met together are asked together, block by block.
void EvidenceMap::number_by_block(std::size_t known, PointVoxels& voxels_of_points) {
    const auto first = static_cast<std::uint32_t>(known);
    const std::vector<std::uint32_t> renumbered = voxels_.group_by_block(first);
    for (std::uint32_t& voxel : voxels_of_points) {
        if (voxel != kNoVoxel && voxel >= first) voxel = renumbered[voxel - first];
    }
    neighbors_.update(voxels_);
}

/// Of the voxels from `known` on; their states are alike until now.
void EvidenceMap::find_centroids(std::size_t known, const MapPoints& in_map,
                                 const PointVoxels& voxels_of_points) {
    std::vector<std::uint32_t> counts(voxels_.size() - known);
    for (std::size_t i = 0; i < voxels_of_points.size(); ++i) {
        const std::uint32_t voxel = voxels_of_points[i];
        if (voxel == kNoVoxel || voxel < known) continue;
        states_[voxel].centroid +=
            in_map.points[i] - center(in_map.keys[i], voxel_size_);  // so floats lose nothing
        ++counts[voxel - known];
    }
    for (std::size_t v = known; v < voxels_.size(); ++v) {
        const auto id = static_cast<std::uint32_t>(v);
        Point& centroid = states_[v].centroid;
        centroid =
            center(voxels_.key(id), voxel_size_) + centroid / static_cast<float>(counts[v - known]);
    }
}

/// The voxel of that key, which this scan owns.
std::uint32_t EvidenceMap::own(VoxelKey key) {
    const std::uint32_t voxel = voxels_.insert(key);
    if (voxel == states_.size()) states_.push_back({.evidence = {.first_owner = scans_}});
    touched_.resize(voxels_.blocks());
    touched_[voxels_.block_of_voxel(voxel)] = scans_;
    Evidence& e = states_[voxel].evidence;
    if (e.owned == 0 || e.last_owner != scans_) {
        e.last_owner = scans_;
        if (e.owned < UINT16_MAX) ++e.owned;
        states_[voxel].opinion = transience(e);
    }
    return voxel;
}

std::vector<std::uint32_t> EvidenceMap::within(const Point& center, float radius) const {
    const float reach = radius + 4.0F * voxel_size_;  // of the middle of a block
    std::vector<std::uint32_t> found;
    for (std::uint32_t b = 0; b < voxels_.blocks(); ++b) {
        if ((middle_of(b) - center).norm() > reach) continue;
        voxels_.each_in_block(b, [&](std::uint32_t v) {
            if ((states_[v].centroid - center).norm() <= radius) found.push_back(v);
        });
    }
    return found;
}

std::vector<std::uint32_t> EvidenceMap::keep_within(const Point& center, float radius,
                                                    std::size_t most_voxels) {
    const auto distance_of = [&](std::uint32_t voxel) {
        return (middle_of(voxels_.block_of_voxel(voxel)) - center).norm();
    };
    std::vector<float> distances(voxels_.size());
    for (std::uint32_t v = 0; v < distances.size(); ++v) distances[v] = distance_of(v);
    if (distances.size() > most_voxels) {
        std::vector<float> sorted = distances;
        const auto farthest = sorted.begin() + static_cast<std::ptrdiff_t>(most_voxels);
        std::nth_element(sorted.begin(), farthest, sorted.end());
        radius = std::min(radius, *farthest);
    }
    std::vector<std::uint32_t> kept;
    for (std::uint32_t v = 0; v < distances.size(); ++v) {
        if (distances[v] <= radius) kept.push_back(v);
    }
    const VoxelIndex voxels = std::exchange(voxels_, {});
    const auto touched = std::exchange(touched_, {});
    const auto states = std::exchange(states_, {});
    for (const std::uint32_t v : kept) {
        voxels_.insert(voxels.key(v));
        if (touched_.size() < voxels_.blocks()) {
            touched_.push_back(touched[voxels.block_of_voxel(v)]);
        }
        states_.push_back(states[v]);
    }
    neighbors_ = {};
    neighbors_.update(voxels_);
    return kept;
}

std::vector<std::size_t> EvidenceMap::keyframes() const {
    std::vector<std::size_t> indices;
    for (const Observer& observer : observers_) indices.push_back(observer.index);
    return indices;
}

std::vector<std::vector<std::size_t>> EvidenceMap::seen_through(
    std::span<const std::uint32_t> voxels) const {
    std::vector<std::uint32_t> place(voxels_.size(), kNoVoxel), blocks;  // place among `voxels`
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        place[voxels[i]] = static_cast<std::uint32_t>(i);
        blocks.push_back(voxels_.block_of_voxel(voxels[i]));
    }
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    std::vector<std::vector<std::size_t>> result(voxels.size());
    constexpr std::size_t kGrain = 64;  // blocks
    parallel_for(blocks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        Glance glance{.first = 0, .end = static_cast<std::uint32_t>(voxels_.size())};
        for (const Observer& observer : observers_) {
            see({&blocks[begin], end - begin}, glance, observer);
            for (std::size_t i = 0; i < glance.voxels.size(); ++i) {
                const std::uint32_t at = place[glance.voxels[i]];
                if (glance.sights[i] != Sight::passed || at == kNoVoxel) continue;
                result[at].push_back(observer.index);
            }
        }
    });
    return result;
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
        map.neighbors_.each_around(map.voxels_, 2, block, [&](std::uint32_t v, const Cell& cell) {
            add(cell, map.states_[v].opinion, map.states_[v].evidence);
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
        if (is_unknown(states_[voxels[i]].evidence)) continue;
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
            const float vote = neighborhood.vote_on(unpack(voxels_.key(v)), states_[v].evidence);
            result[at] = 1.0F / (1.0F + std::exp(3.0F * (states_[v].opinion + vote)));
        }
    });
    return result;
}

}  // namespace dynamic_filter
