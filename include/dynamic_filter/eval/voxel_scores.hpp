// SPDX-License-Identifier: MIT
/// @file
/// Preservation rate (PR), rejection rate (RR) and F1 of a static map, counted over voxels (Sec.
/// IV-A).
///
/// - Units: [m]; scores are fractions 0..1.
/// - Frames: any, but the same for both maps.
/// - Shapes: maps are given point by point.
/// - Ownership: values.
/// - Threads: a VoxelTally has a single caller.
/// - Errors: none; a score that is not defined is empty.
#pragma once

#include <cstddef>
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

/// Scores over voxels; a score is empty if the raw map has no voxel of that kind.
struct VoxelScore {
    std::optional<double> pr;  ///< 0..1: preserved static voxels / static voxels of the raw map
    std::optional<double>
        rr;  ///< 0..1: 1 - preserved dynamic voxels / dynamic voxels of the raw map
    std::optional<double> f1;  ///< 0..1: harmonic mean of pr and rr
};

/// Numbers of voxels from which a VoxelScore is computed. Those of areas without common voxels can
/// be added.
struct VoxelTotals {
    std::size_t static_total = 0;   ///< static voxels of the raw map
    std::size_t static_kept = 0;    ///< those of them that the result preserved
    std::size_t dynamic_total = 0;  ///< dynamic voxels of the raw map
    std::size_t dynamic_kept = 0;   ///< those of them that the result preserved

    /// Adds the voxels of another area.
    void add(const VoxelTotals& other);
    /// The scores, 0..1.
    [[nodiscard]] VoxelScore score() const;
};

/// Computes the scores, 0..1, from numbers of voxels (Sec. IV-A).
VoxelScore voxel_score(double static_total, double static_kept, double dynamic_total,
                       double dynamic_kept);

/// Counts the points of one voxel, of the raw map or of a clean map.
struct VoxelCount {
    std::uint32_t still = 0;       ///< static points
    std::uint32_t dynamic = 0;     ///< dynamic points
    std::uint32_t unlabelled = 0;  ///< points of a map without labels
    /// [m] sum of the coordinates of the labelled points.
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();

    /// True if the voxel holds any point.
    [[nodiscard]] bool has_points() const { return still + dynamic + unlabelled > 0; }
};

/// Counts the voxels of the raw map and of the clean maps of one or more results. The caller must
/// leave out points of unknown ground truth. Single caller.
class VoxelTally {
public:
    /// `voxel_size` [m]; 1 to 32 results.
    explicit VoxelTally(double voxel_size, std::size_t results = 1);
    VoxelTally(VoxelTally&&) noexcept;  ///< the moved-from object can only be destroyed
    ~VoxelTally();

    /// A point of the raw map, and the results that removed it: bit r stands for result r.
    struct TruePoint {
        Point point;            ///< [m]
        Label truth;            ///< ground truth; must not be unknown
        std::uint32_t removed;  ///< one bit per result
    };
    /// Adds points of the raw map. Many points per call, such as a whole scan, are faster than few.
    void add(std::span<const TruePoint> points);
    /// Adds one point of a clean map that another program made; it belongs to result 0.
    void add_map_point(const Point& point);

    /// Scores of one result. The keys name four ways to count a voxel that holds points of both
    /// kinds:
    ///
    /// - "excluded" (the default): it counts as neither static nor dynamic.
    /// - "static_wins": it is static.
    /// - "majority": it has the kind of most of its points; static on a tie.
    /// - "erasor": the centroid of each voxel gets the label of the majority. It is preserved if
    ///   the nearest centroid of the clean map lies within half a voxel diagonal and has the same
    ///   label. This key is missing for maps without labels.
    [[nodiscard]] std::map<std::string, VoxelScore> scores(std::size_t result = 0) const;
    /// The numbers of voxels behind them, with the same keys.
    [[nodiscard]] std::map<std::string, VoxelTotals> totals(std::size_t result = 0) const;

    [[nodiscard]] std::size_t voxels() const;          ///< number of voxels with points
    [[nodiscard]] std::size_t dynamic_voxels() const;  ///< those of them with a dynamic point

private:
    double voxel_size_;
    std::unique_ptr<VoxelIndex> index_;
    // Counts per voxel: one for the raw map, one for the removed points of each result.
    std::size_t stride_;
    std::vector<VoxelCount> counts_;
    bool unlabelled_ = false;
};

}  // namespace dynamic_filter::eval
