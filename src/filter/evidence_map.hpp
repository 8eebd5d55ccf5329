// SPDX-License-Identifier: MIT
/// The map of the method "scans": its voxels, its keyframes, and what the keyframes observed of the
/// voxels.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "dynamic_filter/types.hpp"
#include "filter/evidence_grid.hpp"
#include "filter/keyframes.hpp"
#include "filter/line_of_sight.hpp"

namespace dynamic_filter {

/// Each keyframe observes each voxel once. A new keyframe observes all voxels known so far. A new
/// voxel is observed by the earlier keyframes: by all of the newest ones, and by a selection that
/// stands for the older ones. So nothing is computed twice. The result is nearly that of letting
/// all keyframes observe all voxels in their reach; with few keyframes it is exactly that.
///
/// Single caller; const members may run in several threads. Poses and points are in the map frame.
class EvidenceMap {
public:
    explicit EvidenceMap(const Config& config, const std::optional<CellBounds>& bounds = {});

    /// The next scan is the first one of another drive.
    void begin_drive();

    /// Lets a scan of an earlier drive (counted from 0) observe the voxels that were found after
    /// that drive. Give the scans of a drive in their order. Whether the scan is a keyframe is
    /// decided as it was before.
    void look_again(std::size_t drive, const Scan& scan);

    /// Which of the scans of an earlier drive, in their order, look_again() would use. Their points
    /// are not needed.
    [[nodiscard]] std::vector<bool> are_to_look_again(std::span<const Scan> scans) const;

    /// Writes what a filter needs to go on with another drive, or reads it into a map without
    /// scans. The newest scan must have observed all that it observes.
    void archive(Archive& archive);

    /// Adds a scan whose `T_world_sensor` is relative to the map. Only the voxels around its own
    /// points are observed here. Returns the voxel of each point. Cost: the points, plus new voxels
    /// times keyframes that observe them.
    PointVoxels insert(const Scan& scan, StageTimes& times);

    /// If the scan of the last insert() is a keyframe: lets it observe the rest of the map, where
    /// it has no points. Call it once after each insert(). Cost: the blocks of voxels, plus the
    /// voxels of the blocks in view.
    void observe_elsewhere(StageTimes& times);

    /// See EvidenceGrid::keep_within().
    std::vector<std::uint32_t> keep_within(const Point& center, float radius,
                                           std::size_t most_voxels) {
        return grid_.keep_within(center, radius, most_voxels);
    }

    /// For each of the voxels, keyframes that see through it (their Scan::index, ascending). If
    /// more than 64 keyframes are kept, only every second, third and so on is checked. The list may
    /// differ from the keyframes that counted, because a new voxel is observed by a selection, in
    /// which one keyframe may stand for several. Runs in parallel. Cost: blocks of these voxels
    /// times checked keyframes.
    [[nodiscard]] std::vector<std::vector<std::size_t>> free_keyframes(
        std::span<const std::uint32_t> voxels) const;

    /// What the keyframe observes of each of the places [m].
    [[nodiscard]] std::vector<Sight> look(const Keyframe& keyframe, const Points& places) const;

    /// Lets the kept keyframes observe the voxels anew, each place only if `may_see` is true.
    void observe_again(std::span<const std::uint32_t> voxels,
                       const std::function<bool(const Keyframe&, const Point&)>& may_see);

    /// [m] By how much the poses of two scans disagree, on average: by the motions that align them,
    /// and 0 for those that need none.
    [[nodiscard]] float disagreement() const {
        return static_cast<float>(disagreement_ /
                                  static_cast<double>(std::max<std::size_t>(1, indices_.size())));
    }

    /// Scan::index of an owner (Evidence::first_owner or last_owner).
    [[nodiscard]] std::size_t index_of_owner(std::uint32_t owner) const { return indices_[owner]; }
    /// [m] Where the sensor was in the scan of an owner.
    [[nodiscard]] const Point& sensor_of_owner(std::uint32_t owner) const {
        return sensors_[owner];
    }
    [[nodiscard]] const EvidenceGrid& grid() const { return grid_; }
    [[nodiscard]] EvidenceGrid& grid() { return grid_; }
    [[nodiscard]] const Keyframes& keyframes() const { return keyframes_; }

private:
    struct Places;
    struct BlockParts;
    template <class Wanted>
    [[nodiscard]] Places places_in(std::vector<std::uint32_t> blocks, const Wanted& wanted) const;
    template <class Wanted>
    [[nodiscard]] Places places_in(BlockParts parts, const Wanted& wanted) const;
    void check_known(std::span<const std::uint32_t> blocks);
    template <class Wanted>
    void observe(const Keyframes& keyframes, std::span<const std::uint32_t> blocks, bool newest,
                 const Wanted& wanted);
    BlockParts record(const Places& places, const std::vector<Sight>& sights, bool newest);
    void check_new();
    void align(const Scan& scan);
    void move_to_newest(Places& places) const;
    [[nodiscard]] SightMargins margins_for(const Keyframe& keyframe) const;
    [[nodiscard]] std::vector<std::size_t> blocks_in_sight(std::span<const std::uint32_t> blocks,
                                                           const Keyframe& keyframe,
                                                           const Eigen::Isometry3f& aligned,
                                                           float slack) const;
    [[nodiscard]] std::vector<Sight> look(const Keyframe& keyframe, const Places& places,
                                          const Eigen::Isometry3f& aligned) const;

    [[nodiscard]] bool may_observe(const Scan& scan) const;

    SightMargins margins_;
    float alignment_gain_;                     // ScansConfig::Sight::alignment_gain
    std::optional<Eigen::AlignedBox2d> area_;  // [m] of the bounds, in the map
    EvidenceGrid grid_;
    Keyframes keyframes_;
    KeyframeConfig keyframe_;
    std::vector<std::uint32_t> known_after_;  // by drive that has ended: number of voxels
    /// The drive that looks again.
    struct Again {
        std::optional<std::size_t> drive;
        Keyframes keyframes;                // keeps one keyframe
        std::vector<std::uint32_t> blocks;  // with voxels that were found after the drive
    } again_;
    /// How the newest scan fits the surfaces of a keyframe that it asks: a motion in the map.
    struct Alignment {
        std::uint32_t owner;  // of the keyframe
        Eigen::Isometry3f to_keyframe, to_newest;
    };
    std::vector<Alignment> alignments_;  // as asked, oldest first; empty: all are the identity
    std::size_t fitting_ = 0;            // number of scans in a row that need no alignment
    float moved_by_ = 0.0F;              // [m] by these motions, at most
    double disagreement_ = 0.0;          // [m] sum over the scans
    std::vector<std::size_t> indices_;   // Scan::index in the order of the scans
    Points sensors_;                     // [m] place of the sensor, in the same order
    std::uint32_t known_ = 0;            // number of voxels before the newest scan
    bool is_due_ = false;                // true if observe_elsewhere() is due
};

}  // namespace dynamic_filter
