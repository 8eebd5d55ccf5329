// SPDX-License-Identifier: MIT
/// What the preflight looks at: a few scans, in pairs.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/io/sequence.hpp"

namespace dynamic_filter::io {

struct Sample {
    Points upright;  ///< sensor frame, what stands upright within 30 m
    Pose T_world_sensor = Pose::Identity();
    /// Of the pairs of points in nearly the same direction, how many are at different ranges; 0 if
    /// there are few.
    double doubled = 0.0;
    /// Points within a few metres of the frame's origin, and of where the pose says the sensor is.
    std::size_t near_origin = 0, near_pose = 0;
    std::optional<double> began;  ///< [s] the earliest point's, if the points have absolute times
};
using Samples = std::map<std::size_t, Sample>;  ///< by the scan's index

constexpr std::array<std::size_t, 4> kApart = {1, 3, 8, 20};  ///< scans of a pair
struct Pair {
    std::size_t from, apart;
};
std::vector<Pair> choose_pairs(std::size_t scans, std::size_t places);

/// The first scan and those of the pairs; what cannot be used is told in `unusable`.
Samples read_samples(const Sequence& sequence, const std::vector<Pair>& pairs,
                     std::map<std::size_t, std::string>& unusable);

}  // namespace dynamic_filter::io
