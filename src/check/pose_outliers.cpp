// SPDX-License-Identifier: MIT
#include "check/pose_outliers.hpp"

#include <cmath>

namespace dynamic_filter::io {
namespace {

/// [m] How far pose i is from the straight line through two others, beyond what a vehicle can do:
/// an acceleration of 10 m/s^2, and noise. 0 if that cannot be told.
double apart_from(std::span<const Pose> poses, std::span<const double> stamps, std::size_t a,
                  std::size_t b, std::size_t i) {
    constexpr double kNoise = 0.3, kAcceleration = 10.0;  // [m], [m/s^2]
    const double from_a = stamps[i] - stamps[a], from_b = stamps[i] - stamps[b];
    if (from_a == 0.0 || from_b == 0.0 || stamps[a] == stamps[b]) return 0.0;
    const Eigen::Vector3d at_a = poses[a].translation(), at_b = poses[b].translation();
    const Eigen::Vector3d expected = at_a + from_a / (stamps[b] - stamps[a]) * (at_b - at_a);
    const double off = (poses[i].translation() - expected).norm();
    const double possible = kNoise + kAcceleration * std::abs(from_a * from_b);
    return std::isfinite(off) && off > possible ? off - possible : 0.0;
}

/// True if without pose i, the trajectory before it leads to where it is after it, and back. Where
/// it jumps, it does not.
bool fits_without(std::span<const Pose> poses, std::span<const double> stamps, std::size_t i) {
    const bool on = i < 2 || apart_from(poses, stamps, i - 2, i - 1, i + 1) == 0.0;
    const bool back =
        i + 2 >= poses.size() || apart_from(poses, stamps, i + 2, i + 1, i - 1) == 0.0;
    return on && back;
}

}  // namespace

std::vector<std::size_t> outliers_of(std::span<const Pose> poses, std::span<const double> stamps) {
    std::vector<double> apart(poses.size(), 0.0);  // [m]
    for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
        apart[i] = apart_from(poses, stamps, i - 1, i + 1, i);
    }
    // The neighbours of an outlier lie apart as well, but by half as much.
    std::vector<std::size_t> outliers;
    for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
        const bool is_most = apart[i] > apart[i - 1] && apart[i] >= apart[i + 1];
        if (is_most && fits_without(poses, stamps, i)) outliers.push_back(i);
    }
    return outliers;
}

}  // namespace dynamic_filter::io
