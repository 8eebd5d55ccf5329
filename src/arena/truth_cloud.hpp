// SPDX-License-Identifier: MIT
/// The ground truth of DynamicMap_Benchmark: one cloud of all points, in gt_cloud.pcd. The
/// intensities of the scans are no truth: av2 has none, and those of semindoor are the sensor's.
#pragma once

#include "arena/arena.hpp"

namespace dynamic_filter::app {

/// The points of gt_cloud.pcd that belong to the scans of the trial, x y z intensity, 1 where it
/// moves. If the trial is a part of the folder's scans, that is the part of the cloud that holds
/// their points. Throws InputError if the file is missing, or does not hold them.
io::Cloud truth_cloud(const Trial& trial, const io::Recording& recording);

/// x y z of the files, of points that are not labelled dynamic, with an intensity of 0. Throws
/// InputError if a scan has no labels, or if nothing is left.
io::Cloud clean_cloud(const io::Recording& recording, const std::filesystem::path& labels);

/// Whether each point of the truth is within 0.05 m of a clean map.
std::vector<char> near_map(const Points& truth, const Points& map);

/// Appends a point to a cloud of x y z intensity.
void put_point(io::Cloud& cloud, const Point& p, float intensity);

/// SA, DA, AA, HA of DynamicMap_Benchmark: how much of the truth is within 0.05 m of a clean map.
ArenaScores by_truth_cloud(const Trial& trial, const io::Recording& recording,
                           const Estimate& estimate);

}  // namespace dynamic_filter::app
