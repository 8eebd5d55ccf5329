// SPDX-License-Identifier: MIT
/// @file
/// Scores of a result against ground truth: preservation rate (PR), rejection rate (RR) and F1 of a
/// static map, counted over voxels (Sec. IV-A), and per point the accuracies of
/// DynamicMap_Benchmark and the moving IoU.
///
/// - Units: [m]; scores are fractions 0..1.
/// - Frames: any, but the same for all scans and maps.
/// - Shapes: labels are parallel to their points; maps are given point by point.
/// - Ownership: values; scans, sources and maps are borrowed for the call.
/// - Threads: a VoxelTally has a single caller; ScanScores says what may run in several threads;
///   all else is thread-safe. Sources are called from several threads.
/// - Errors: Error if arrays are not parallel; exceptions of a source are passed on; a score that
///   is not defined is empty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
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

    /// True if the voxel holds any point.
    [[nodiscard]] bool has_points() const { return still + dynamic + unlabelled > 0; }
};

/// Counts the voxels of the raw map and of the clean maps of one or more results. The caller must
/// leave out points of unknown ground truth. Single caller.
class VoxelTally {
public:
    /// `voxel_size` [m]; 1 to 32 results. `shift` [m]: how far the grid is moved against the
    /// multiples of `voxel_size`, along each axis.
    explicit VoxelTally(double voxel_size, std::size_t results = 1, double shift = 0.0);
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

    /// Scores of one result. The keys name three ways to count a voxel that holds points of both
    /// kinds:
    ///
    /// - "excluded" (the default): it counts as neither static nor dynamic.
    /// - "static_wins": it is static.
    /// - "majority": it has the kind of most of its points; static on a tie.
    [[nodiscard]] std::map<std::string, VoxelScore> scores(std::size_t result = 0) const;
    /// The numbers of voxels behind them, with the same keys.
    [[nodiscard]] std::map<std::string, VoxelTotals> totals(std::size_t result = 0) const;

    [[nodiscard]] std::size_t voxels() const;          ///< number of voxels with points
    [[nodiscard]] std::size_t dynamic_voxels() const;  ///< those of them with a dynamic point

private:
    double voxel_size_;
    Point shift_;
    std::unique_ptr<VoxelIndex> index_;
    // Counts per voxel: one for the raw map, one for the removed points of each result.
    std::size_t stride_;
    std::vector<VoxelCount> counts_;
};

/// Scores per point. A score is empty if the ground truth has no point of that kind, or if no
/// labels were given.
struct PointScore {
    /// Static accuracy, 0..1: share of static points within 0.05 m of the clean map.
    std::optional<double> sa;
    /// Dynamic accuracy, 0..1: share of dynamic points farther than that from it.
    std::optional<double> da;
    std::optional<double> aa;   ///< associated accuracy, 0..1: sqrt(sa * da)
    std::optional<double> ha;   ///< harmonic accuracy, 0..1: harmonic mean of sa and da
    std::optional<double> iou;  ///< moving IoU, 0..1: TP / (TP + FP + FN) of the dynamic class
};

/// Counts the ground-truth points of each kind, and those of them that are covered: they lie within
/// the distance (0.05 m) of the clean map.
struct CoverCount {
    std::size_t still = 0;            ///< static points
    std::size_t dynamic = 0;          ///< dynamic points
    std::size_t covered_still = 0;    ///< covered static points
    std::size_t covered_dynamic = 0;  ///< covered dynamic points
    /// Adds one point whose ground truth is known.
    void add(Label truth, bool covered);
    /// Adds the points of another count.
    void add(const CoverCount& other);
};

/// Computes the scores from the counts; the IoU stays empty.
PointScore point_score(const CoverCount& count);

/// Counts of the dynamic class, from which its IoU is computed.
struct Confusion {
    std::size_t true_positive = 0;   ///< labelled dynamic, and dynamic
    std::size_t false_positive = 0;  ///< labelled dynamic, but not dynamic
    std::size_t false_negative = 0;  ///< not labelled dynamic, but dynamic
    /// Adds one point. The caller must leave out points of unknown ground truth, because unknown
    /// counts as not dynamic.
    void add(Label truth, Label verdict);
    /// Adds the points of another count.
    void add(const Confusion& other);
    /// TP / (TP + FP + FN), 0..1; empty if no point is dynamic or labelled dynamic.
    [[nodiscard]] std::optional<double> iou() const;
};

/// All scores of one result.
struct Scores {
    /// Keys: how voxels with points of both kinds are counted, see VoxelTally::scores().
    std::map<std::string, VoxelScore> voxel;
    /// The same on a grid that is shifted by half a voxel along each axis, or empty. It shows
    /// whether the grid suits the result by chance, such as a map of these voxels.
    std::map<std::string, VoxelScore> voxel_shifted{};
    PointScore point;            ///< over all points
    double dynamic_share = 0.0;  ///< 0..1: voxels with a dynamic point / all voxels
};

/// The counts from which Scores are computed. Those of areas without common voxels can be added, so
/// that an area that does not fit into memory can be scored piece by piece. At the borders of the
/// pieces, points of one piece are not covered by points of another one.
struct ScoreSums {
    std::map<std::string, VoxelTotals> voxel;  ///< keys as in Scores
    /// On the shifted grid, or empty. They add up only if areas have none of its voxels in common
    /// either.
    std::map<std::string, VoxelTotals> voxel_shifted{};
    CoverCount cover;                ///< of all points
    Confusion confusion;             ///< of all points
    std::size_t voxels = 0;          ///< with points
    std::size_t dynamic_voxels = 0;  ///< those of them with a dynamic point

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

/// On which grids of voxels results are scored: on the multiples of the voxel size alone, or also
/// on the grid that is shifted by half a voxel along each axis.
enum class Grids : std::uint8_t { aligned, aligned_and_shifted };

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
    /// `voxel_size` [m]; number of results.
    ScanScores(double voxel_size, std::size_t results, Grids grids = Grids::aligned);
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
    std::vector<VoxelTally> tallies_;  ///< by grid; the first one is aligned
    std::vector<Result> results_;
    std::unique_ptr<RemovedCells> removed_;
};

/// Scores the verdicts on `scans` scans, with voxels of `voxel_size` [m] of both grids. The clean
/// map consists of all points that are not labelled dynamic.
Scores score_labels(std::size_t scans, const ScanSource& source, double voxel_size);

/// Scores a clean map given as points in the frame of the scans, with voxels of `voxel_size` [m]
/// of both grids. The IoU stays empty.
Scores score_map(std::size_t scans, const ScanSource& source, const Points& map, double voxel_size);

}  // namespace dynamic_filter::eval
