// SPDX-License-Identifier: MIT
/// @file
/// Computes all scores of a result against ground truth.
///
/// - Units: [m]; scores are fractions 0..1.
/// - Frames: any, but the same for all scans and the map.
/// - Shapes: arrays of one scan are parallel.
/// - Ownership: sources and maps are borrowed for the call.
/// - Threads: thread-safe; sources are called from several threads.
/// - Errors: exceptions of a source are passed on.
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

/// All scores of one result.
struct Scores {
    /// Keys: how voxels with points of both kinds are counted, see VoxelTally::scores().
    std::map<std::string, VoxelScore> voxel;
    PointScore point;            ///< over all points
    double dynamic_share = 0.0;  ///< 0..1: voxels with a dynamic point / all voxels
};

/// The counts from which Scores are computed. Those of areas without common voxels can be added, so
/// that an area that does not fit into memory can be scored piece by piece. At the borders of the
/// pieces, points of one piece are not covered by points of another one.
struct ScoreSums {
    std::map<std::string, VoxelTotals> voxel;  ///< keys as in Scores
    CoverCount cover;                          ///< of all points
    Confusion confusion;                       ///< of all points
    std::size_t voxels = 0;                    ///< with points
    std::size_t dynamic_voxels = 0;            ///< those of them with a dynamic point

    /// Adds the counts of another area.
    void add(const ScoreSums& other);
    /// The scores over all areas that were added.
    [[nodiscard]] Scores scores() const;
};

/// A scan with its ground truth; all arrays are parallel. Points of unknown ground truth are left
/// out of every score.
struct LabelledScan {
    Points points;  ///< [m] in one frame for all scans; coordinates must be small enough for floats
    Labels truth;   ///< one per point
    Labels verdict;  ///< one per point; empty if a map is scored
};

/// Returns scan i, or nothing if the scan was rejected. It is called more than once per scan, and
/// from several threads.
using ScanSource = std::function<std::optional<LabelledScan>(std::size_t)>;

constexpr double kVoxelSize = 0.2;  ///< [m] edge of a voxel, Sec. IV-A
/// [m] distance within which a point is covered, as in DynamicMap_Benchmark.
constexpr double kCoverDistance = 0.05;

/// Scores one or more results on the same recording, scan by scan. First add() every scan; then
/// call near_removed() for every scan and pass its result to add_near(). The clean map of a result
/// consists of all points that are not labelled dynamic. near_removed() may run in several threads;
/// all other members have a single caller. Memory: the voxels, the removed points, and the kept
/// points near the removed ones.
class ScanScores {
public:
    ScanScores(double voxel_size, std::size_t results);  ///< `voxel_size` [m]; number of results
    ScanScores(ScanScores&&) noexcept;  ///< the moved-from object can only be destroyed
    ~ScanScores();

    /// Adds a scan. `verdicts` holds the labels of each result, one per point;
    /// LabelledScan::verdict is not used. Throws Error if arrays are not parallel.
    void add(const LabelledScan& scan, std::span<const Labels* const> verdicts);

    /// For each result, the kept points that may cover a removed point. Call it after all scans are
    /// added.
    [[nodiscard]] std::vector<Points> near_removed(const LabelledScan& scan,
                                                   std::span<const Labels* const> verdicts) const;
    /// Adds a result of near_removed(); the order does not matter.
    void add_near(const std::vector<Points>& points);

    /// Scores of one result over all added scans. Removed points count as covered only by points
    /// given to add_near().
    [[nodiscard]] Scores scores(std::size_t result) const;
    /// The counts behind them.
    [[nodiscard]] ScoreSums sums(std::size_t result) const;

private:
    struct Result;
    class RemovedCells;
    VoxelTally tally_;
    std::vector<Result> results_;
    std::unique_ptr<RemovedCells> removed_;
};

/// Scores the verdicts on `scans` scans, with voxels of `voxel_size` [m]. The clean map consists of
/// all points that are not labelled dynamic.
Scores score_labels(std::size_t scans, const ScanSource& source, double voxel_size);

/// Scores a clean map given as points in the frame of the scans, with voxels of `voxel_size` [m].
/// The IoU stays empty.
Scores score_map(std::size_t scans, const ScanSource& source, const Points& map, double voxel_size);

}  // namespace dynamic_filter::eval
