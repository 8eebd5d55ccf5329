// SPDX-License-Identifier: MIT
/// @file
/// All scores of one result against ground truth.
///
/// - Units: [m]; scores are fractions 0..1.
/// - Frames: any one for all scans and the map.
/// - Shapes: arrays of one scan are parallel.
/// - Ownership: sources and maps are borrowed for the call.
/// - Threads: thread-safe; sources are called from several.
/// - Errors: what a source throws.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/eval/point_scores.hpp"
#include "dynamic_filter/eval/voxel_scores.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::eval {

/// What a result is worth.
struct Scores {
    std::map<std::string, VoxelScore> voxel;  ///< by reading of mixed voxels, see VoxelTally
    PointScore point;                         ///< over all points
    double dynamic_share = 0.0;               ///< 0..1: voxels with a dynamic point / voxels
};

/// A scan with ground truth; all parallel. Points of unknown truth are left out of every score.
struct LabelledScan {
    Points points;   ///< any one frame for all scans, near enough to its origin for floats
    Labels truth;    ///< one per point
    Labels verdict;  ///< one per point, or empty when a map is scored
};

/// Gives scan i, or nothing if it was rejected. Called more than once per scan, in parallel.
using ScanSource = std::function<std::optional<LabelledScan>(std::size_t)>;

constexpr double kVoxelSize = 0.2;       ///< [m] Sec. IV-A
constexpr double kCoverDistance = 0.05;  ///< [m] DynamicMap_Benchmark's rule

/// Scores of one or more results on the same recording, scan by scan: first add() every scan, then
/// add_near() what near_removed() says of every scan. The clean map of a result is every point not
/// labelled dynamic. near_removed() may run in several threads; the rest has a single caller.
/// Memory: the voxels, the removed points, and the kept ones near those.
class ScanScores {
public:
    ScanScores(double voxel_size, std::size_t results);  ///< [m]
    ScanScores(ScanScores&&) noexcept;                   ///< the other one can only be destroyed
    ~ScanScores();

    /// `verdicts` are of the results, each one per point; the scan's own verdict is not used.
    /// Throws Error if arrays are not parallel.
    void add(const LabelledScan& scan, std::span<const Labels* const> verdicts);

    /// By result, the kept points that may cover a removed one, once all scans are added.
    [[nodiscard]] std::vector<Points> near_removed(const LabelledScan& scan,
                                                   std::span<const Labels* const> verdicts) const;
    /// What near_removed() gave, in any order.
    void add_near(const std::vector<Points>& points);

    /// Of one result, over all scans added; the cover of removed points counts what add_near() got.
    [[nodiscard]] Scores scores(std::size_t result) const;

private:
    struct Result;
    class RemovedCells;
    VoxelTally tally_;
    std::vector<Result> results_;
    std::unique_ptr<RemovedCells> removed_;
};

/// Scores the verdicts of so many scans, on voxels of `voxel_size` [m]: the clean map is every
/// point not labelled dynamic.
Scores score_labels(std::size_t scans, const ScanSource& source, double voxel_size);

/// Scores a clean map given as points (same frame as the scans), on voxels of `voxel_size` [m]. No
/// IoU.
Scores score_map(std::size_t scans, const ScanSource& source, const Points& map, double voxel_size);

}  // namespace dynamic_filter::eval
