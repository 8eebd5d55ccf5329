// SPDX-License-Identifier: MIT
/// Measures how well scans overlay.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "check/samples.hpp"
#include "dynamic_filter/check.hpp"

namespace dynamic_filter::io {

/// An interpretation of poses: where a scan is if the interpretation is right.
struct Reading {
    std::string name;
    std::function<Pose(const Pose&)> pose;
    bool is_chained = false;  ///< true: of chained() poses
};
inline constexpr const char *kAsGiven = "as given", *kInWorld = "points in world",
                            *kInSensor = "points in sensor", *kPointsInFeet = "points in feet";
const std::vector<Reading>& readings();  ///< "as given" is first
Pose pose_of(const Sample& sample, const Reading& reading);

/// Mean share of each interpretation, in the order of readings(); empty if no pair could be read.
std::vector<Overlay> compare(const Samples& samples, const std::vector<Pair>& pairs);

/// Share, 0..1, of points of `to` that fall into voxels with points of `from`.
double overlay_of(const Points& from, const Points& to, const Pose& T_from_to);

/// Result of a search for the best position of scan b around the position from its pose.
struct Search {
    double given = 0.0, best = 0.0;  ///< shares at the given and at the best position
    double offset = 0.0;             ///< [m] distance of the best from the given position
};
Search search_around(const Sample& a, const Sample& b);

}  // namespace dynamic_filter::io
