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
#include <span>
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

/// Points of one voxel, of the raw map or of a clean one.
struct VoxelCount {
    std::uint32_t still = 0;                        ///< points of static things
    std::uint32_t dynamic = 0;                      ///< points of moving things
    std::uint32_t unlabelled = 0;                   ///< points of a map given without labels
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  ///< [m] of the labelled points' coordinates

    /// Whether there is any.
    [[nodiscard]] bool has_points() const { return still + dynamic + unlabelled > 0; }
};

/// Tallies the raw map and the clean maps of one or more results. Points of unknown ground truth
/// must be left out by the caller. Single caller.
class VoxelTally {
public:
    explicit VoxelTally(double voxel_size, std::size_t results = 1);  ///< [m]; 1 to 32 results
    VoxelTally(VoxelTally&&) noexcept;  ///< the other one can only be destroyed
    ~VoxelTally();

    /// A point of the raw map, and which results removed it: bit r stands for result r.
    struct TruePoint {
        Point point;            ///< [m]
        Label truth;            ///< not unknown
        std::uint32_t removed;  ///< bits
    };
    /// Those of a scan, say: many at a time are quicker.
    void add(std::span<const TruePoint> points);
    /// One point of a clean map that was made elsewhere; it is result 0.
    void add_map_point(const Point& point);

    /// How a voxel holding points of both kinds is read. Keys of the result:
    /// "excluded" (the default): it counts for neither kind; "static_wins": it is static;
    /// "majority": the more frequent kind, static on a tie;
    /// "erasor": every voxel's centroid with its majority label finds its nearest centroid of the
    /// clean map; within half a voxel's diagonal and with the same label it is preserved. Left out
    /// for maps without labels.
    [[nodiscard]] std::map<std::string, VoxelScore> scores(std::size_t result = 0) const;

    /// 0..1: share of voxels with at least one dynamic point.
    [[nodiscard]] double dynamic_share() const;

private:
    double voxel_size_;
    std::unique_ptr<VoxelIndex> index_;
    std::size_t stride_;  // counts of a voxel: of the raw map, and of what each result removed
    std::vector<VoxelCount> counts_;
    bool unlabelled_ = false;
};

}  // namespace dynamic_filter::eval
