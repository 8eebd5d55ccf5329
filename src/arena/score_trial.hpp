// SPDX-License-Identifier: MIT
/// The rules of the arenas: each scores an estimate of one trial. All throw InputError if a scan
/// cannot be read, or has no labels.
#pragma once

#include "arena/arena.hpp"
#include "dynamic_filter/scores.hpp"

namespace dynamic_filter::app {

/// PR, RR, F1 of ERASOR's script; its map frame is that of the trial.
ArenaScores by_erasor(const Trial& trial, const io::Recording& recording, const Estimate& estimate);
/// PR, RR, F1 of FreeDOM's tool: voxels of 0.2 m from 2.7 m on; one static point makes them static.
ArenaScores by_strict(const Trial& trial, const io::Recording& recording, const Estimate& estimate);
/// SA, DA, AA, HA of SemanticKITTI's scans as DynamicMap_Benchmark extracts them: up to 50 m, and
/// points without a label are static.
ArenaScores by_cover_to_50_m(const Trial& trial, const io::Recording& recording,
                             const Estimate& estimate);
/// Moving IoU of all points together.
ArenaScores by_moving(const Trial& trial, const io::Recording& recording, const Estimate& estimate);
/// The same from 3 to 50 m.
ArenaScores by_moving_to_50_m(const Trial& trial, const io::Recording& recording,
                              const Estimate& estimate);
/// Moving IoU of the split and of all labelled scans, then SA, DA and AA of the latter.
ArenaScores by_moving_and_cover(const Trial& trial, const io::Recording& recording,
                                const Estimate& estimate);
/// Mean over the scans of the moving IoU, from 0.5 to 20 m and of all points. That of a scan
/// without any point that moves or is labelled so is 1.
ArenaScores by_scan(const Trial& trial, const io::Recording& recording, const Estimate& estimate);
/// PR, RR, F1 without mixed voxels, AA and the moving IoU: the scores of this project.
ArenaScores by_voxels(const Trial& trial, const io::Recording& recording, const Estimate& estimate);

// What they share with others of this room.

/// The scans with ground truth, by index.
std::vector<std::size_t> scored_scans(const Trial& trial, const io::Recording& recording);

/// SA, DA, AA, HA.
ArenaScores accuracies(const eval::PointScore& score);
/// The labels of scan i. Throws InputError if there are none, or not one for each point.
Labels verdict_of(const std::filesystem::path& labels, const io::Recording& recording,
                  std::size_t i, std::size_t points);
/// The points of a map, less the origin. Throws InputError if it has none, or one that is not
/// finite, because such maps seem to have nothing that moves.
Points map_of(const Estimate& estimate, const Eigen::Vector3d& origin);

}  // namespace dynamic_filter::app
