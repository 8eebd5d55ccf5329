// SPDX-License-Identifier: MIT
#include "check/pose_outliers.hpp"

#include <cmath>

namespace dynamic_filter::io {
namespace {

/// [m] How far pose i is from the middle between two others, beyond what a vehicle can do: an
/// acceleration of 10 m/s^2, and noise. 0 if that cannot be told.
double apart_from(std::span<const Pose> poses, std::span<const double> stamps, std::size_t before,
                  std::size_t i, std::size_t after) {
    constexpr double kNoise = 0.3, kAcceleration = 10.0;  // [m], [m/s^2]
    const double since = stamps[i] - stamps[before], until = stamps[after] - stamps[i];
    if (!(since > 0.0) || !(until > 0.0)) return 0.0;
    const Eigen::Vector3d a = poses[before].translation(), b = poses[after].translation();
    const Eigen::Vector3d expected = a + since / (since + until) * (b - a);
    const double off = (poses[i].translation() - expected).norm();
    const double possible = kNoise + kAcceleration * since * until;
    return std::isfinite(off) && off > possible ? off - possible : 0.0;
}

/// True if the neighbours fit to each other without pose i. Where a trajectory jumps to where it
/// goes on, they do not.
bool fits_without(std::span<const Pose> poses, std::span<const double> stamps, std::size_t i) {
    const bool before = i < 2 || apart_from(poses, stamps, i - 2, i - 1, i + 1) == 0.0;
    const bool after =
        i + 2 >= poses.size() || apart_from(poses, stamps, i - 1, i + 1, i + 2) == 0.0;
    return before && after;
}

}  // namespace

std::vector<std::size_t> outliers_of(std::span<const Pose> poses, std::span<const double> stamps) {
    std::vector<double> apart(poses.size(), 0.0);  // [m]
    for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
        apart[i] = apart_from(poses, stamps, i - 1, i, i + 1);
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
