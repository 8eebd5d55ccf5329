// SPDX-License-Identifier: MIT
/// How well scans lie on one another.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dynamic_filter/io/preflight.hpp"
#include "samples.hpp"

namespace dynamic_filter::io {

/// Where a scan would be under another reading of its pose.
struct Reading {
    std::string name;
    std::function<Pose(const Pose&)> pose;
};
inline constexpr const char *kAsGiven = "as given", *kInWorld = "points in world",
                            *kInSensor = "points in sensor";
const std::vector<Reading>& readings();  ///< as given first

/// The mean share of each reading, in their order; empty if no pair was read.
std::vector<Overlay> compare(const Samples& samples, const std::vector<Pair>& pairs);

/// The best place for scan b around the one that its pose gives it.
struct Search {
    double given = 0.0, best = 0.0;  ///< shares
    double offset = 0.0;             ///< [m] of the best from the given
};
Search search_around(const Sample& a, const Sample& b);

}  // namespace dynamic_filter::io
