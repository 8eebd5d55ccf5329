// SPDX-License-Identifier: MIT
#include "arena/score_trial.hpp"

#include <fmt/format.h>

#include <cmath>

#include "dynamic_filter/error.hpp"
#include "formats/label_files.hpp"
#include "recording/scans.hpp"
#include "run/scored_scans.hpp"
#include "score/erasor_maps.hpp"
#include "score/for_each_scan.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

/// The scan with the ground truth of the arena.
io::FullScan read_scan(const Trial& trial, const io::Recording& recording, std::size_t i) {
    io::FullScan scan = recording.read(i);
    if (trial.truth) scan.truth = trial.truth(recording, i, scan);
    if (scan.truth.empty()) {
        throw InputError(recording.info().scan_files[i], "",
                         scan.truth_fault.empty() ? "has no ground truth" : scan.truth_fault);
    }
    if (trial.T_map_sensor) scan.T_world_sensor = trial.T_map_sensor(scan.T_world_sensor);
    return scan;
}

/// The scans to be scored, in a frame that begins at `origin`.
struct Scored {
    std::vector<std::size_t> scans;
    eval::ScanSource source;

    [[nodiscard]] std::size_t size() const { return scans.size(); }
};

/// The arguments must outlive what is returned. A scan that cannot be read ends the scoring,
/// because figures without it would not be those of the arena.
Scored scored(const Trial& trial, const io::Recording& recording, const Estimate& estimate,
              const ScoredPart& part, const std::vector<std::size_t>& scans,
              const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
    return {scans, [&trial, &recording, &estimate, part, scans, origin](std::size_t n) {
                const std::size_t i = scans[n];
                const io::FullScan full = read_scan(trial, recording, i);
                eval::LabelledScan scan = labelled(full, origin, part);
                if (estimate.labels) {
                    scan.verdict = verdict_of(*estimate.labels, recording, i, scan.truth.size());
                }
                return std::optional(std::move(scan));
            }};
}

void require_verdicts(const Estimate& estimate) {
    if (estimate.labels) return;
    throw InputError(*estimate.map, "",
                     "is a map; this arena scores the labels of scans: give a folder of them");
}

/// The scores of this project, from which most others can be taken.
eval::Scores scores_of(const Trial& trial, const io::Recording& recording, const Estimate& estimate,
                       const ScoredPart& part) {
    const Eigen::Vector3d origin = scoring_origin(recording, eval::kVoxelSize);
    const Scored scans =
        scored(trial, recording, estimate, part, scored_scans(trial, recording), origin);
    if (estimate.labels) return eval::score_labels(scans.size(), scans.source, eval::kVoxelSize);
    return eval::score_map(scans.size(), scans.source, map_of(estimate, origin), eval::kVoxelSize);
}

std::vector<eval::Confusion> confusions(const Trial& trial, const io::Recording& recording,
                                        const Estimate& estimate, const ScoredPart& part,
                                        const std::vector<std::size_t>& chosen) {
    require_verdicts(estimate);
    const Scored scans = scored(trial, recording, estimate, part, chosen);
    std::vector<eval::Confusion> found;
    eval::for_each_scan(scans.size(), scans.source,
                        [&](std::size_t, const eval::LabelledScan& scan) {
                            eval::Confusion& one = found.emplace_back();
                            for (std::size_t p = 0; p < scan.truth.size(); ++p) {
                                if (scan.truth[p] == Label::unknown) continue;
                                one.add(scan.truth[p], scan.verdict[p]);
                            }
                        });
    return found;
}

std::optional<double> iou_together(const std::vector<eval::Confusion>& scans) {
    eval::Confusion sum;
    for (const eval::Confusion& scan : scans) sum.add(scan);
    return sum.iou();
}

std::optional<double> mean_iou(const std::vector<eval::Confusion>& scans) {
    if (scans.empty()) return {};
    double sum = 0.0;
    for (const eval::Confusion& scan : scans) sum += scan.iou().value_or(1.0);
    return sum / static_cast<double>(scans.size());
}

ArenaScores rates(const eval::VoxelScore& score) { return {score.pr, score.rr, score.f1}; }

}  // namespace

std::vector<std::size_t> scored_scans(const Trial& trial, const io::Recording& recording) {
    return trial.scored.empty() ? all_scans(recording) : trial.scored;
}

ArenaScores accuracies(const eval::PointScore& score) {
    return {score.sa, score.da, score.aa, score.ha};
}

Labels verdict_of(const fs::path& labels, const io::Recording& recording, std::size_t i,
                  std::size_t points) {
    const fs::path file = io::label_file(labels, io::stem(recording, i));
    Labels verdict = io::read_labels(file);
    if (verdict.size() == points) return verdict;
    throw InputError(
        file, "", fmt::format("has {} labels, but the scan has {} points", verdict.size(), points));
}

Points map_of(const Estimate& estimate, const Eigen::Vector3d& origin) {
    Points points = positions_from(io::read_cloud(*estimate.map), origin);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].allFinite()) continue;
        throw InputError(*estimate.map, fmt::format("point {}", i),
                         "is not finite; a map with such points cannot be scored");
    }
    if (points.empty()) throw InputError(*estimate.map, "", "has no points");
    return points;
}

ArenaScores by_erasor(const Trial& trial, const io::Recording& recording,
                      const Estimate& estimate) {
    const Scored scans =
        scored(trial, recording, estimate, part_of_erasor({}), scored_scans(trial, recording));
    if (estimate.labels) {
        return rates(eval::score_erasor(scans.size(), scans.source, eval::kVoxelSize).score());
    }
    const Points map = map_of(estimate, Eigen::Vector3d::Zero());
    return rates(eval::score_erasor(scans.size(), scans.source, map, eval::kVoxelSize).score());
}

ArenaScores by_strict(const Trial& trial, const io::Recording& recording,
                      const Estimate& estimate) {
    const ScoredPart part{.min = 2.7, .max = 1000.0};
    return rates(scores_of(trial, recording, estimate, part).voxel.at("static_wins"));
}

ArenaScores by_cover_to_50_m(const Trial& trial, const io::Recording& recording,
                             const Estimate& estimate) {
    const ScoredPart part{.max = std::nextafter(50.0, 0.0), .unlabelled_is_static = true};
    return accuracies(scores_of(trial, recording, estimate, part).point);
}

ArenaScores by_moving(const Trial& trial, const io::Recording& recording,
                      const Estimate& estimate) {
    return {
        iou_together(confusions(trial, recording, estimate, {}, scored_scans(trial, recording)))};
}

ArenaScores by_moving_to_50_m(const Trial& trial, const io::Recording& recording,
                              const Estimate& estimate) {
    return {iou_together(confusions(trial, recording, estimate, {.min = 3.0, .max = 50.0},
                                    scored_scans(trial, recording)))};
}

ArenaScores by_moving_and_cover(const Trial& trial, const io::Recording& recording,
                                const Estimate& estimate) {
    require_verdicts(estimate);
    const eval::PointScore points = scores_of(trial, recording, estimate, {}).point;
    return {iou_together(confusions(trial, recording, estimate, {}, trial.split)), points.iou,
            points.sa, points.da, points.aa};
}

ArenaScores by_scan(const Trial& trial, const io::Recording& recording, const Estimate& estimate) {
    const std::vector<std::size_t> scans = scored_scans(trial, recording);
    const ScoredPart near{.min = 0.5, .max = 20.0};
    return {mean_iou(confusions(trial, recording, estimate, near, scans)),
            mean_iou(confusions(trial, recording, estimate, {}, scans))};
}

ArenaScores by_voxels(const Trial& trial, const io::Recording& recording,
                      const Estimate& estimate) {
    const eval::Scores scores = scores_of(trial, recording, estimate, {});
    ArenaScores out = rates(scores.voxel.at("excluded"));
    out.push_back(scores.point.aa);
    out.push_back(scores.point.iou);
    return out;
}

}  // namespace dynamic_filter::app
