// SPDX-License-Identifier: MIT
/// @file
/// Preservation rate, rejection rate and F1 of a static map, voxel by voxel (Sec. IV-A).
///
/// - Units: [m]; scores are fractions 0..1.
/// - Frames: any one for both maps.
/// - Shapes: point by point.
/// - Ownership: values.
/// - Threads: a VoxelTally has a single caller.
/// - Errors: none; what cannot be said is empty.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {
class VoxelIndex;
}

namespace dynamic_filter::eval {

/// Fractions; empty where the raw map holds nothing of that kind.
struct VoxelScore {
    std::optional<double> pr;  ///< 0..1: preserved static voxels / static voxels of the raw map
    std::optional<double>
        rr;  ///< 0..1: 1 - preserved dynamic voxels / dynamic voxels of the raw map
    std::optional<double> f1;  ///< 0..1: harmonic mean of the two
};

/// The fractions, 0..1, of such counts of voxels.
VoxelScore voxel_score(double static_total, double static_kept, double dynamic_total,
                       double dynamic_kept);

/// Points of one voxel of the raw map, and those of them that the clean map kept.
struct VoxelCount {
    std::uint32_t still = 0;                             ///< points of static things
    std::uint32_t dynamic = 0;                           ///< points of moving things
    std::uint32_t kept_still = 0;                        ///< of the static ones, in the clean map
    std::uint32_t kept_dynamic = 0;                      ///< of the moving ones, in the clean map
    std::uint32_t kept_unlabelled = 0;                   ///< points of a map given without labels
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();       ///< [m] of the points' coordinates
    Eigen::Vector3d kept_sum = Eigen::Vector3d::Zero();  ///< [m] the same of those kept

    /// Whether the clean map has a point in it.
    [[nodiscard]] bool preserved() const { return kept_still + kept_dynamic + kept_unlabelled > 0; }
};

/// Tallies the raw map and the clean map. Points of unknown ground truth must be left out by the
/// caller. Single caller.
class VoxelTally {
public:
    explicit VoxelTally(double voxel_size);  ///< [m]
    VoxelTally(VoxelTally&&) noexcept;       ///< the other one can only be destroyed
    ~VoxelTally();

    /// One point of the raw map, and whether the clean map kept it.
    void add(const Point& point, Label truth, bool kept);
    /// One point of a clean map that was made elsewhere.
    void add_map_point(const Point& point);

    /// How a voxel holding points of both kinds is read. Keys of the result:
    /// "excluded" (the default): it counts for neither kind; "static_wins": it is static;
    /// "majority": the more frequent kind, static on a tie;
    /// "erasor": every voxel's centroid with its majority label finds its nearest centroid of the
    /// clean map; within half a voxel's diagonal and with the same label it is preserved. Left out
    /// for maps without labels.
    [[nodiscard]] std::map<std::string, VoxelScore> scores() const;

    /// 0..1: share of voxels with at least one dynamic point.
    [[nodiscard]] double dynamic_share() const;

private:
    [[nodiscard]] VoxelScore erasor_score() const;
    VoxelCount* find(const Point& point, bool insert);

    double voxel_size_;
    std::unique_ptr<VoxelIndex> index_;
    std::vector<VoxelCount> counts_;
    bool unlabelled_ = false;
};

}  // namespace dynamic_filter::eval
