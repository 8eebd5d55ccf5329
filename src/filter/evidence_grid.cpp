// SPDX-License-Identifier: MIT
#include "filter/evidence_grid.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

#include <utility>

namespace dynamic_filter {

namespace {

/// Cache of the voxels of this scan that were met last. Each ring or column of the scan comes back
/// to the same voxels.
class OwnVoxels {
public:
    struct Entry {
        VoxelKey key = kNoKey;
        std::uint32_t voxel = kNoVoxel;
    };
    /// The entry in which the voxel is, or into which the caller must write it.
    Entry& at(VoxelKey key) { return entries_[VoxelHash{}(key) % entries_.size()]; }

private:
    std::vector<Entry> entries_ = std::vector<Entry>(4096);
};

/// Points whose voxels are still to be found; they are collected until there are enough to
/// prefetch.
struct Waiting {
    std::array<std::size_t, 32> points{};
    std::array<VoxelKey, 32> keys{};
    std::array<std::uint32_t, 32> voxels{};
    std::size_t count = 0;
};

}  // namespace

PointVoxels EvidenceGrid::add_points(const Scan& scan) {
    MapPoints in_map;
    to_voxels(scan.points, scan.T_world_sensor, voxel_size_, in_map);
    PointVoxels voxels_of_points(scan.points.size(), kNoVoxel);
    const std::size_t known = voxels_.size();
    OwnVoxels own_voxels;
    Waiting waiting;
    const auto find = [&] {
        const auto voxels = std::span(waiting.voxels).first(waiting.count);
        own(std::span(waiting.keys).first(waiting.count), voxels);
        for (std::size_t k = 0; k < voxels.size(); ++k) {
            voxels_of_points[waiting.points[k]] = voxels[k];
            own_voxels.at(waiting.keys[k]) = {waiting.keys[k], voxels[k]};
        }
        waiting.count = 0;
    };
    for (std::size_t i = 0; i < voxels_of_points.size(); ++i) {
        const VoxelKey key = in_map.keys[i];
        if (key == kNoKey || (bounds_ && !bounds_->contain(key))) continue;
        const OwnVoxels::Entry& entry = own_voxels.at(key);
        if (entry.key == key) {
            voxels_of_points[i] = entry.voxel;
            continue;
        }
        waiting.points[waiting.count] = i;
        waiting.keys[waiting.count] = key;
        if (++waiting.count == waiting.keys.size()) find();
    }
    find();
    number_by_block(known, voxels_of_points);
    find_centroids(known, in_map, voxels_of_points);
    ++scans_;
    return voxels_of_points;
}

/// Numbers the new voxels block by block, because later they are accessed block by block, too.
void EvidenceGrid::number_by_block(std::size_t known, PointVoxels& voxels_of_points) {
    const auto first = static_cast<std::uint32_t>(known);
    const std::vector<std::uint32_t> renumbered = voxels_.group_by_block(first);
    for (std::uint32_t& voxel : voxels_of_points) {
        if (voxel != kNoVoxel && voxel >= first) voxel = renumbered[voxel - first];
    }
    neighbors_.update(voxels_);
}

/// Computes the centroids of the voxels from `known` on, which are new.
void EvidenceGrid::find_centroids(std::size_t known, const MapPoints& in_map,
                                  const PointVoxels& voxels_of_points) {
    std::vector<std::uint32_t> counts(voxels_.size() - known);
    for (std::size_t i = 0; i < voxels_of_points.size(); ++i) {
        const std::uint32_t voxel = voxels_of_points[i];
        if (voxel == kNoVoxel || voxel < known) continue;
        states_[voxel].centroid +=
            // Relative to the center of the voxel, so that floats lose no precision.
            in_map.points[i] - center(in_map.keys[i], voxel_size_);
        ++counts[voxel - known];
    }
    for (std::size_t v = known; v < voxels_.size(); ++v) {
        const auto id = static_cast<std::uint32_t>(v);
        Point& centroid = states_[v].centroid;
        centroid =
            center(voxels_.key(id), voxel_size_) + centroid / static_cast<float>(counts[v - known]);
    }
}

/// Finds the voxels of these keys, and records this scan as their owner.
void EvidenceGrid::own(std::span<const VoxelKey> keys, std::span<std::uint32_t> voxels) {
    voxels_.insert(keys, voxels);
    states_.resize(voxels_.size(), {.evidence = {.first_owner = scans_}});
    touched_.resize(voxels_.blocks());
    sure_.resize(voxels_.blocks());
    for (const std::uint32_t voxel : voxels) __builtin_prefetch(&states_[voxel]);
    for (const std::uint32_t voxel : voxels) {
        touched_[voxels_.block_of_voxel(voxel)] = scans_;
        Evidence& e = states_[voxel].evidence;
        if (e.n_own == 0 || e.last_owner != scans_) record_owner(e, scans_);
    }
}

bool EvidenceGrid::record(std::uint32_t voxel, Sight sight, unsigned weight, bool newest) {
    State& state = states_[voxel];
    const bool hit = newest && state.evidence.last_owner + 1 == scans_;
    return dynamic_filter::record(state.evidence, {sight, weight, hit}, longest_run_);
}

void EvidenceGrid::update_score(std::uint32_t voxel) {
    State& state = states_[voxel];
    state.score = is_unknown(state.evidence) ? 0.0F : score_(state.evidence);
}

void EvidenceGrid::archive(Archive& archive) {
    constexpr std::size_t kUsed = sizeof(Point) + sizeof(float) + sizeof(Evidence);
    static_assert(std::has_unique_object_representations_v<Evidence>);
    std::vector<VoxelKey> keys;
    for (std::uint32_t v = 0; v < voxels_.size(); ++v) keys.push_back(voxels_.key(v));
    archive.values(keys);
    archive.values(states_, kUsed);
    archive.values(sure_);
    archive.value(scans_);
    if (!archive.reads()) return;
    // In their order, voxels and blocks get the numbers that they had.
    for (const VoxelKey key : keys) voxels_.insert(key);
    touched_.assign(voxels_.blocks(), 0);
    neighbors_.update(voxels_);
}

std::vector<std::uint32_t> EvidenceGrid::blocks_touched(bool touched) const {
    std::vector<std::uint32_t> blocks;
    for (std::uint32_t b = 0; b < voxels_.blocks(); ++b) {
        if ((touched_[b] + 1 == scans_) == touched) blocks.push_back(b);
    }
    return blocks;
}

std::vector<std::uint32_t> EvidenceGrid::blocks_from(std::uint32_t first) const {
    std::vector<std::uint32_t> blocks;
    for (std::uint32_t v = first; v < size(); ++v) {
        const std::uint32_t block = voxels_.block_of_voxel(v);
        if (blocks.empty() || blocks.back() != block) blocks.push_back(block);
    }
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
}

std::vector<std::uint32_t> EvidenceGrid::within(const Point& center, float radius) const {
    const float reach = radius + 4.0F * voxel_size_;  // measured from the center of a block
    std::vector<std::uint32_t> found;
    for (std::uint32_t b = 0; b < voxels_.blocks(); ++b) {
        if ((middle_of(b) - center).norm() > reach) continue;
        voxels_.each_in_block(b, [&](std::uint32_t v) {
            if ((states_[v].centroid - center).norm() <= radius) found.push_back(v);
        });
    }
    return found;
}

std::vector<std::uint32_t> EvidenceGrid::keep_within(const Point& center, float radius,
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
    sure_.assign(voxels_.blocks(), 0);
    neighbors_ = {};
    neighbors_.update(voxels_);
    return kept;
}

}  // namespace dynamic_filter
