// SPDX-License-Identifier: MIT
/// The scans that the preflight check reads, in pairs.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::io {

/// [m] Median distance of the points from the sensor; 0 if none is measured.
float typical_range(const Points& points);

struct Sample {
    Points upright;  ///< sensor frame; see upright_points()
    Pose T_world_sensor = Pose::Identity();
    Pose T_world_chained = Pose::Identity();  ///< if poses are motions from scan to scan
    /// Share of pairs of points in nearly the same direction that have different ranges; 0 if there
    /// are few such pairs.
    double doubled = 0.0;
    /// Numbers of points within a few metres of the origin, and of the position in the pose.
    std::size_t near_origin = 0, near_pose = 0;
    Eigen::Vector2f middle = Eigen::Vector2f::Zero();  ///< [m] median of x and y of the points
    float typical_range = 0.0F;  ///< [m] median distance of the points from the sensor
    /// [m] Distance from one number of the type of the coordinates to the next, where they lie.
    double step = 0.0;
    std::optional<double> began;  ///< [s] time of the earliest point, if points have absolute times
};
using Samples = std::map<std::size_t, Sample>;  ///< keys: index of the scan

/// Separations of the scans of a pair.
constexpr std::array<std::size_t, 4> kApart = {1, 3, 8, 20};
struct Pair {
    std::size_t from, apart;
};
std::vector<Pair> choose_pairs(std::size_t scans, std::size_t places);

/// Reads the first scan and those of the pairs; adds the faults of unusable ones to `unusable`.
Samples read_samples(const Recording& recording, const std::vector<Pair>& pairs,
                     std::map<std::size_t, std::string>& unusable);

/// The pairs that can be compared: those whose poses lie within 20 m, if those of all neighbors do.
/// Scans that are farther apart share few structures, and then the walls of a street overlay best
/// as if the sensor had not moved. If neighbors are far apart already, the poses may be wrong, so
/// all pairs are compared.
std::vector<Pair> comparable(const Samples& samples, const std::vector<Pair>& pairs);

}  // namespace dynamic_filter::io
