// SPDX-License-Identifier: MIT
#include "filter/final_map.hpp"

#include <numeric>

#include "dynamic_filter/parallel.hpp"
#include "filter/vote.hpp"

namespace dynamic_filter {

namespace {

template <class Use>
void each_within(const EvidenceGrid& grid, int cells, std::uint32_t voxel, const Use& use) {
    grid.neighbors().each_within(grid.voxels(), cells, voxel, use);
}

std::optional<ContactSurface> contact_of(std::uint32_t voxel,
                                         const std::vector<VoxelDecision>& decided,
                                         const EvidenceGrid& grid, const Config& config) {
    const auto label = [&](std::uint32_t v) {
        return label_of(decided[v].probability, config.map.occupancy_threshold);
    };
    if (label(voxel) != Label::static_) return std::nullopt;
    bool touches_dynamic = false;
    each_within(grid, 1, voxel,
                [&](std::uint32_t v, int) { touches_dynamic |= label(v) == Label::dynamic; });
    if (!touches_dynamic) return std::nullopt;
    std::vector<VoxelVerdict> around;
    each_within(grid, 2, voxel, [&](std::uint32_t v, int distance) {
        around.push_back({grid[v].centroid, label(v), distance});
    });
    return contact_surface(around, config.scans.contact);
}

/// Indices of points of static voxels that lie above the surface of their voxel.
std::vector<std::size_t> points_above(const LocatedScan& scan,
                                      const std::vector<VoxelDecision>& decided,
                                      const Labels& labels, const ScansConfig::Contact& config) {
    std::vector<std::size_t> above;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] != Label::static_) continue;
        const auto& contact = decided[scan.voxels[i]].contact;
        if (!contact) continue;
        const float least = std::max(static_cast<float>(config.height),
                                     static_cast<float>(config.roughness) * contact->roughness);
        if (contact->height(scan.in_map.points[i]) > least) above.push_back(i);
    }
    return above;
}

}  // namespace

std::vector<VoxelDecision> decide_voxels(const EvidenceGrid& grid, const Config& config) {
    std::vector<std::uint32_t> all(grid.size());
    std::iota(all.begin(), all.end(), 0U);
    const auto occupancy = occupancy_of(grid, all, config.scans);
    std::vector<VoxelDecision> decided(all.size());
    for (std::size_t v = 0; v < all.size(); ++v) decided[v].probability = occupancy[v];
    parallel_for(all.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            decided[v].contact = contact_of(all[v], decided, grid, config);
        }
    });
    return decided;
}

std::vector<std::optional<std::uint32_t>> occupied_since(const std::vector<VoxelDecision>& decided,
                                                         const EvidenceGrid& grid,
                                                         const Config& config) {
    std::vector<std::optional<std::uint32_t>> since(grid.size());
    const auto longest = static_cast<std::uint32_t>(config.scans.evidence.longest_run);
    for (std::uint32_t v = 0; v < decided.size(); ++v) {
        const Label label = label_of(decided[v].probability, config.map.occupancy_threshold);
        if (label != Label::dynamic) continue;
        const Evidence& e = grid[v].evidence;
        const bool is_seen = e.last == Sight::occupied && e.run >= longest && !e.seen_empty;
        // With fewer scans, the points may only lie near the voxel.
        const bool has_points = e.last_owner - e.since + 1 >= longest;
        if (is_seen && has_points) since[v] = e.since;
    }
    return since;
}

void decide_points(const LocatedScan& scan, const std::vector<VoxelDecision>& decided,
                   const EvidenceGrid& grid, const Config& config, Verdict& verdict) {
    std::vector<bool> moving(decided.size());  // dynamic voxels with a point in this scan
    for (std::size_t i = 0; i < scan.voxels.size(); ++i) {
        if (scan.voxels[i] >= decided.size()) continue;  // also for kNoVoxel
        const auto& probability = decided[scan.voxels[i]].probability;
        verdict.labels[i] = label_of(probability, config.map.occupancy_threshold);
        verdict.probability[i] = probability.value_or(0.0F);
        if (verdict.labels[i] == Label::dynamic) moving[scan.voxels[i]] = true;
    }
    for (const std::size_t i : points_above(scan, decided, verdict.labels, config.scans.contact)) {
        bool touches = false;
        each_within(grid, 2, scan.voxels[i], [&](std::uint32_t v, int) { touches |= moving[v]; });
        if (touches) verdict.labels[i] = Label::dynamic;
    }
}

}  // namespace dynamic_filter
