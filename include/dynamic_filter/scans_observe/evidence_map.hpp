// SPDX-License-Identifier: MIT
/// The map of the method in which scans observe: voxels, keyframes, and what these say of those.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/config.hpp"
#include "dynamic_filter/scans_observe/evidence_grid.hpp"
#include "dynamic_filter/scans_observe/line_of_sight.hpp"
#include "dynamic_filter/scans_observe/observers.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Every voxel is checked once by every keyframe: a new keyframe checks the voxels known so far, a
/// new voxel asks the keyframes kept so far: the newest all, of the older ones a selection that
/// stands for them. So nothing is computed twice, and the result is nearly (with few keyframes:
/// exactly) that of asking all keyframes about all voxels in their reach.
///
/// Single caller; const members may run in several threads. Poses and points are in the map frame.
class EvidenceMap {
public:
    explicit EvidenceMap(const Config& config);

    /// Takes a scan whose `T_world_sensor` is relative to the map, as far as the voxels around its
    /// own points are concerned; returns the voxel of each point. Cost: points, plus new voxels
    /// times keyframes asked.
    PointVoxels insert(const Scan& scan, StageTimes& times);

    /// Lets that scan, if it is a keyframe, check the rest of the map, where it has no points. Call
    /// it once after each insert(). Cost: blocks of voxels, plus the voxels of those within sight.
    void observe_elsewhere(StageTimes& times);

    /// See EvidenceGrid.
    std::vector<std::uint32_t> keep_within(const Point& center, float radius,
                                           std::size_t most_voxels) {
        return grid_.keep_within(center, radius, most_voxels);
    }

    /// For each of the voxels, keyframes (their Scan::index, ascending) that see through it: of all
    /// that are kept, or of every second, third ... where they are more than 64. A voxel asked
    /// others at the time, and may have counted one for several. In parallel; cost: blocks of those
    /// voxels times keyframes asked.
    [[nodiscard]] std::vector<std::vector<std::size_t>> free_keyframes(
        std::span<const std::uint32_t> voxels) const;

    /// Scan::index of an owner (Evidence::first_owner, last_owner).
    [[nodiscard]] std::size_t index_of_owner(std::uint32_t owner) const { return indices_[owner]; }
    [[nodiscard]] const EvidenceGrid& grid() const { return grid_; }
    [[nodiscard]] EvidenceGrid& grid() { return grid_; }
    [[nodiscard]] const Observers& observers() const { return observers_; }

private:
    struct Places;
    template <class Wanted>
    [[nodiscard]] Places places_in(std::vector<std::uint32_t> blocks, const Wanted& wanted) const;
    void check_known(std::span<const std::uint32_t> blocks);
    void check_new();
    [[nodiscard]] SightMargins margins_for(const Observer& observer) const;
    [[nodiscard]] std::vector<std::size_t> blocks_in_sight(std::span<const std::uint32_t> blocks,
                                                           const Observer& observer) const;
    [[nodiscard]] std::vector<Sight> look(const Observer& observer, const Points& centroids) const;
    [[nodiscard]] std::vector<Sight> look(const Observer& observer, const Places& places) const;

    SightMargins margins_;
    EvidenceGrid grid_;
    Observers observers_;
    std::vector<std::size_t> indices_;  // Scan::index by order of the scans
    std::uint32_t known_ = 0;           // voxels before the newest scan
    bool is_due_ = false;               // observe_elsewhere()
};

}  // namespace dynamic_filter
