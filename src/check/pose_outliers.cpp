// SPDX-License-Identifier: MIT
#include "check/pose_outliers.hpp"

#include <cmath>

namespace dynamic_filter::io {

std::vector<std::size_t> outliers_of(std::span<const Pose> poses, std::span<const double> stamps) {
    constexpr double kNoise = 0.3, kAcceleration = 10.0;  // [m], [m/s^2]
    std::vector<double> apart(poses.size(), 0.0);         // [m] beyond what a vehicle can do
    for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
        const double before = stamps[i] - stamps[i - 1], after = stamps[i + 1] - stamps[i];
        if (!(before > 0.0) || !(after > 0.0)) continue;
        const Eigen::Vector3d a = poses[i - 1].translation(), b = poses[i + 1].translation();
        const Eigen::Vector3d expected = a + before / (before + after) * (b - a);
        const double off = (poses[i].translation() - expected).norm();
        const double possible = kNoise + kAcceleration * before * after;
        if (std::isfinite(off) && off > possible) apart[i] = off - possible;
    }
    // The neighbours of an outlier lie apart as well, but by half as much.
    std::vector<std::size_t> outliers;
    for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
        if (apart[i] > apart[i - 1] && apart[i] >= apart[i + 1]) outliers.push_back(i);
    }
    return outliers;
}

}  // namespace dynamic_filter::io
