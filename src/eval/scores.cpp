// SPDX-License-Identifier: MIT
#include "dynamic_filter/eval/scores.hpp"

#include <tsl/robin_set.h>

#include <algorithm>
#include <string>
#include <vector>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/geometry/neighbor_grid.hpp"
#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::eval {

namespace {

constexpr auto kDistance = static_cast<float>(kCoverDistance);

void refuse_unparallel(const LabelledScan& scan, std::size_t i) {
    const std::size_t n = scan.points.size();
    if (scan.truth.size() == n && (scan.verdict.empty() || scan.verdict.size() == n)) return;
    throw Error("scan " + std::to_string(i) + " to be scored has " + std::to_string(n) +
                " points, " + std::to_string(scan.truth.size()) + " truths and " +
                std::to_string(scan.verdict.size()) + " verdicts; expected one per point");
}

/// Calls `use` with every scan in order; a few are read ahead in parallel.
template <class F>
void for_each_scan(std::size_t scans, const ScanSource& source, F&& use) {
    constexpr std::size_t kAhead = 16;
    for (std::size_t first = 0; first < scans; first += kAhead) {
        std::vector<std::optional<LabelledScan>> batch(std::min(kAhead, scans - first));
        parallel_for(batch.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) batch[i] = source(first + i);
        });
        for (std::size_t i = 0; i < batch.size(); ++i) {
            if (!batch[i]) continue;
            refuse_unparallel(*batch[i], first + i);
            use(*batch[i]);
        }
    }
}

template <class F>
void for_each_known_point(const LabelledScan& scan, F&& use) {
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
        if (scan.truth[i] != Label::unknown && scan.points[i].allFinite()) use(i);
    }
}

/// How many of the points that were removed lie near one that was kept. Only kept points in cells
/// next to a removed one are stored, so memory goes with what was removed.
class CoverOfRemoved {
public:
    void add_removed(const Point& point, Label truth) {
        points_.push_back(point);
        truth_.push_back(truth);
        if (const auto cell = cell_of(point, kPerMetre)) cells_.insert(pack(*cell));
    }
    void add_kept(const Point& point) {
        if (touches_removed(point)) kept_.push_back(point);
    }
    void count(CoverCount& count) const {
        const NeighborGrid grid(kept_, 2.0F * kDistance);
        std::vector<char> covered(points_.size(), 0);
        parallel_for(points_.size(), 4096, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                covered[i] = grid.any_within(points_[i], kDistance) ? 1 : 0;
            }
        });
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const bool dynamic = truth_[i] == Label::dynamic;
            (dynamic ? count.dynamic : count.still) += 1;
            if (covered[i] != 0) (dynamic ? count.covered_dynamic : count.covered_still) += 1;
        }
    }

private:
    static constexpr float kPerMetre = 0.5F / kDistance;

    [[nodiscard]] bool touches_removed(const Point& point) const {
        for (int corner = 0; corner < 8; ++corner) {
            const Point shift((corner & 1) != 0 ? kDistance : -kDistance,
                              (corner & 2) != 0 ? kDistance : -kDistance,
                              (corner & 4) != 0 ? kDistance : -kDistance);
            const auto cell = cell_of(point + shift, kPerMetre);
            if (cell && cells_.contains(pack(*cell))) return true;
        }
        return false;
    }
    Points points_, kept_;
    Labels truth_;
    tsl::robin_set<VoxelKey, VoxelHash> cells_;
};

}  // namespace

Scores score_labels(std::size_t scans, const ScanSource& source, double voxel_size) {
    VoxelTally tally(voxel_size);
    Confusion confusion;
    CoverOfRemoved cover;
    CoverCount count;
    for_each_scan(scans, source, [&](const LabelledScan& scan) {
        for_each_known_point(scan, [&](std::size_t i) {
            const bool kept = scan.verdict[i] != Label::dynamic;
            tally.add(scan.points[i], scan.truth[i], kept);
            confusion.add(scan.truth[i], scan.verdict[i]);
            if (!kept) cover.add_removed(scan.points[i], scan.truth[i]);
        });
    });
    for_each_scan(scans, source, [&](const LabelledScan& scan) {
        for_each_known_point(scan, [&](std::size_t i) {
            if (scan.verdict[i] == Label::dynamic) return;
            cover.add_kept(scan.points[i]);
            const bool dynamic = scan.truth[i] == Label::dynamic;  // a kept point covers itself
            (dynamic ? count.dynamic : count.still) += 1;
            (dynamic ? count.covered_dynamic : count.covered_still) += 1;
        });
    });
    cover.count(count);
    Scores scores{tally.scores(), point_score(count), tally.dynamic_share()};
    scores.point.iou = confusion.iou();
    return scores;
}

Scores score_map(std::size_t scans, const ScanSource& source, const Points& map,
                 double voxel_size) {
    const NeighborGrid grid(map, 2.0F * kDistance);
    VoxelTally tally(voxel_size);
    CoverCount count;
    for_each_scan(scans, source, [&](const LabelledScan& scan) {
        for_each_known_point(scan, [&](std::size_t i) {
            tally.add(scan.points[i], scan.truth[i], false);
            const bool dynamic = scan.truth[i] == Label::dynamic;
            (dynamic ? count.dynamic : count.still) += 1;
            if (!grid.any_within(scan.points[i], kDistance)) return;
            (dynamic ? count.covered_dynamic : count.covered_still) += 1;
        });
    });
    for (const Point& point : map) tally.add_map_point(point);
    return {tally.scores(), point_score(count), tally.dynamic_share()};
}

}  // namespace dynamic_filter::eval
