// SPDX-License-Identifier: MIT
#include "dynamic_filter/scores.hpp"

#include <tsl/robin_map.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "geometry/neighbor_grid.hpp"
#include "score/for_each_scan.hpp"

namespace dynamic_filter::eval {

namespace {

constexpr auto kDistance = static_cast<float>(kCoverDistance);

double share(std::size_t part, std::size_t all) {
    return all == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(all);
}

void refuse_unparallel(const LabelledScan& scan, const Labels& verdict) {
    const std::size_t n = scan.points.size();
    if (scan.truth.size() == n && verdict.size() == n) return;
    throw Error("a scan to be scored has " + std::to_string(n) + " points, " +
                std::to_string(scan.truth.size()) + " truths and " +
                std::to_string(verdict.size()) + " verdicts; expected one per point");
}

template <class F>
void for_each_known_point(const LabelledScan& scan, F&& use) {
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
        if (scan.truth[i] != Label::unknown && scan.points[i].allFinite()) use(i);
    }
}

/// The aligned grid first.
std::vector<VoxelTally> tallies_of(Grids grids, double voxel_size, std::size_t results) {
    std::vector<VoxelTally> tallies;
    tallies.emplace_back(voxel_size, results);
    if (grids == Grids::aligned_and_shifted) {
        tallies.emplace_back(voxel_size, results, 0.5 * voxel_size);
    }
    return tallies;
}

/// Adds the points of a scan to all grids at once.
void add_points(std::vector<VoxelTally>& tallies, std::span<const VoxelTally::TruePoint> points) {
    parallel_for(tallies.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) tallies[i].add(points);
    });
}

std::map<std::string, VoxelScore> scores_of(const std::map<std::string, VoxelTotals>& totals) {
    std::map<std::string, VoxelScore> scores;
    for (const auto& [reading, numbers] : totals) scores[reading] = numbers.score();
    return scores;
}

}  // namespace

/// The places where results removed points: cells of size 2 kDistance that hold at least one point
/// within kDistance of a removed point along each axis.
class ScanScores::RemovedCells {
public:
    void insert(const Point& point, std::uint32_t results) {
        const auto low = cell_of(point - Point::Constant(kDistance), kPerMetre);
        const auto high = cell_of(point + Point::Constant(kDistance), kPerMetre);
        if (!low || !high || (*low == last_low_ && *high == last_high_ && results == last_)) return;
        last_low_ = *low, last_high_ = *high, last_ = results;
        for (int x = low->x(); x <= high->x(); ++x) {
            for (int y = low->y(); y <= high->y(); ++y) {
                for (int z = low->z(); z <= high->z(); ++z) {
                    const VoxelKey key = pack({x, y, z});
                    const std::size_t bit = bit_of(key);
                    cells_[key] |= results;
                    bits_[bit / 64] |= std::uint64_t{1} << bit % 64;
                }
            }
        }
    }
    /// The results that removed a point which may be near this one, with one bit per result.
    [[nodiscard]] std::uint32_t near(const Point& point) const {
        const auto cell = cell_of(point, kPerMetre);
        if (!cell) return 0;
        const VoxelKey key = pack(*cell);
        const std::size_t bit = bit_of(key);
        if ((bits_[bit / 64] >> bit % 64 & 1U) == 0) return 0;
        const auto it = cells_.find(key);
        return it == cells_.end() ? 0 : it->second;
    }

private:
    // A small table of bits that fits into the cache; for most points it shows at once that no
    // removed point is near.
    static constexpr std::size_t kBits = std::size_t{1} << 23U;
    static constexpr float kPerMetre = 0.5F / kDistance;
    static std::size_t bit_of(VoxelKey key) { return VoxelHash{}(key) % kBits; }
    tsl::robin_map<VoxelKey, std::uint32_t, VoxelHash> cells_;
    std::vector<std::uint64_t> bits_ = std::vector<std::uint64_t>(kBits / 64);
    // Consecutive points often lie in the same cell.
    Cell last_low_ = Cell::Zero(), last_high_ = Cell::Zero();
    std::uint32_t last_ = 0;
};

/// Counts how many of the points that a result removed lie near one that it kept. Only kept points
/// near a removed one are stored, so the memory is proportional to the removed points.
struct ScanScores::Result {
    Points removed{}, near{};  // near: the kept points near a removed one
    Labels removed_truth{};
    CoverCount kept{};  // kept points are covered by themselves
    Confusion confusion{};

    void add(const Point& point, Label truth, Label verdict) {
        confusion.add(truth, verdict);
        if (verdict == Label::dynamic) {
            removed.push_back(point);
            removed_truth.push_back(truth);
            return;
        }
        kept.add(truth, true);
    }
    [[nodiscard]] CoverCount cover() const {
        const NeighborGrid grid(near, 2.0F * kDistance);
        std::vector<char> covered(removed.size(), 0);
        parallel_for(removed.size(), 4096, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                covered[i] = grid.any_within(removed[i], kDistance) ? 1 : 0;
            }
        });
        CoverCount count = kept;
        for (std::size_t i = 0; i < removed.size(); ++i) {
            count.add(removed_truth[i], covered[i] != 0);
        }
        return count;
    }
};

ScanScores::ScanScores(double voxel_size, std::size_t results, Grids grids)
    : tallies_(tallies_of(grids, voxel_size, results)),
      results_(results),
      removed_(std::make_unique<RemovedCells>()) {}
ScanScores::ScanScores(ScanScores&&) noexcept = default;
ScanScores::~ScanScores() = default;

void ScanScores::add(const LabelledScan& scan, std::span<const Labels* const> verdicts) {
    for (const Labels* verdict : verdicts) refuse_unparallel(scan, *verdict);
    std::vector<VoxelTally::TruePoint> points;
    points.reserve(scan.points.size());
    for_each_known_point(scan, [&](std::size_t i) {
        std::uint32_t removed = 0;
        for (std::size_t r = 0; r < results_.size(); ++r) {
            const Label verdict = (*verdicts[r])[i];
            removed |= (verdict == Label::dynamic ? 1U : 0U) << r;
            results_[r].add(scan.points[i], scan.truth[i], verdict);
        }
        if (removed != 0) removed_->insert(scan.points[i], removed);
        points.push_back({scan.points[i], scan.truth[i], removed});
    });
    add_points(tallies_, points);
}

std::vector<Points> ScanScores::near_removed(const LabelledScan& scan,
                                             std::span<const Labels* const> verdicts) const {
    std::vector<Points> near(results_.size());
    for_each_known_point(scan, [&](std::size_t i) {
        const std::uint32_t removed_near = removed_->near(scan.points[i]);
        for (std::size_t r = 0; removed_near >> r != 0; ++r) {
            const bool kept = (*verdicts[r])[i] != Label::dynamic;
            if (kept && (removed_near >> r & 1U) != 0) near[r].push_back(scan.points[i]);
        }
    });
    return near;
}

void ScanScores::add_near(const std::vector<Points>& points) {
    for (std::size_t r = 0; r < results_.size(); ++r) {
        Points& near = results_[r].near;
        near.insert(near.end(), points[r].begin(), points[r].end());
    }
}

ScoreSums ScanScores::sums(std::size_t result) const {
    const Result& one = results_[result];
    auto shifted =
        tallies_.size() > 1 ? tallies_.back().totals(result) : std::map<std::string, VoxelTotals>{};
    return {.voxel = tallies_.front().totals(result),
            .voxel_shifted = std::move(shifted),
            .cover = one.cover(),
            .confusion = one.confusion,
            .voxels = tallies_.front().voxels(),
            .dynamic_voxels = tallies_.front().dynamic_voxels()};
}

Scores ScanScores::scores(std::size_t result) const { return sums(result).scores(); }

void ScoreSums::add(const ScoreSums& other) {
    for (const auto& [reading, numbers] : other.voxel) voxel[reading].add(numbers);
    for (const auto& [reading, numbers] : other.voxel_shifted) voxel_shifted[reading].add(numbers);
    cover.add(other.cover);
    confusion.add(other.confusion);
    voxels += other.voxels;
    dynamic_voxels += other.dynamic_voxels;
}

Scores ScoreSums::scores() const {
    Scores scores;
    scores.voxel = scores_of(voxel);
    scores.voxel_shifted = scores_of(voxel_shifted);
    scores.point = point_score(cover);
    scores.point.iou = confusion.iou();
    scores.dynamic_share = share(dynamic_voxels, voxels);
    return scores;
}

Scores score_labels(std::size_t scans, const ScanSource& source, double voxel_size) {
    ScanScores scores(voxel_size, 1, Grids::aligned_and_shifted);
    for_each_scan(scans, source, [&](std::size_t, const LabelledScan& scan) {
        scores.add(scan, std::array{&scan.verdict});
    });
    for_each_scan(scans, source, [&](std::size_t, const LabelledScan& scan) {
        scores.add_near(scores.near_removed(scan, std::array{&scan.verdict}));
    });
    return scores.scores(0);
}

Scores score_map(std::size_t scans, const ScanSource& source, const Points& map,
                 double voxel_size) {
    const NeighborGrid grid(map, 2.0F * kDistance);
    std::vector<VoxelTally> tallies = tallies_of(Grids::aligned_and_shifted, voxel_size, 1);
    CoverCount count;
    for_each_scan(scans, source, [&](std::size_t, const LabelledScan& scan) {
        refuse_unparallel(scan, scan.verdict.empty() ? scan.truth : scan.verdict);
        std::vector<VoxelTally::TruePoint> points;
        for_each_known_point(scan, [&](std::size_t i) {
            points.push_back({scan.points[i], scan.truth[i], 1});
            count.add(scan.truth[i], grid.any_within(scan.points[i], kDistance));
        });
        add_points(tallies, points);
    });
    for (VoxelTally& tally : tallies) {
        for (const Point& point : map) tally.add_map_point(point);
    }
    const VoxelTally& aligned = tallies.front();
    return {.voxel = aligned.scores(),
            .voxel_shifted = tallies.back().scores(),
            .point = point_score(count),
            .dynamic_share = share(aligned.dynamic_voxels(), aligned.voxels())};
}

}  // namespace dynamic_filter::eval
