// SPDX-License-Identifier: MIT
/// Errors of an estimated trajectory.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <string_view>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

struct PathError {
    double shift = 0.0;      ///< [%] of the distance
    double turn = 0.0;       ///< [deg/m]
    std::size_t pieces = 0;  ///< number of segments that were averaged
};

/// Mean error over all segments of the trajectory that are `length` [m] long.
inline PathError error_over(const std::vector<Pose>& truth, const std::vector<Pose>& found,
                            double length) {
    constexpr double degree = 57.2957795;
    PathError error;
    std::vector<double> way(truth.size(), 0.0);
    for (std::size_t i = 1; i < truth.size(); ++i) {
        way[i] = way[i - 1] + (truth[i].translation() - truth[i - 1].translation()).norm();
    }
    for (std::size_t i = 0, j = 0; i < truth.size(); ++i) {
        while (j < truth.size() && way[j] - way[i] < length) ++j;
        if (j == truth.size()) break;
        const Pose off =
            (truth[i].inverse() * truth[j]).inverse() * (found[i].inverse() * found[j]);
        error.shift += 100.0 * off.translation().norm() / (way[j] - way[i]);
        error.turn += degree * Eigen::AngleAxisd(off.linear()).angle() / (way[j] - way[i]);
        ++error.pieces;
    }
    if (error.pieces > 0) {
        error.shift /= static_cast<double>(error.pieces);
        error.turn /= static_cast<double>(error.pieces);
    }
    return error;
}

/// Largest error [m] from one scan to the next.
inline double worst_step(const std::vector<Pose>& truth, const std::vector<Pose>& found) {
    double worst = 0.0;
    for (std::size_t i = 1; i < truth.size(); ++i) {
        const Pose off =
            (truth[i - 1].inverse() * truth[i]).inverse() * (found[i - 1].inverse() * found[i]);
        worst = std::max(worst, off.translation().norm());
    }
    return worst;
}

/// Prints one line; `clocks` is the processor time for all scans.
inline void print_errors(std::string_view name, const std::vector<Pose>& truth,
                         const std::vector<Pose>& found, std::string_view remarks,
                         std::clock_t clocks) {
    const PathError ten = error_over(truth, found, 10.0), hundred = error_over(truth, found, 100.0);
    const Pose end = truth.front().inverse() * truth.back();
    const Pose end_found = found.front().inverse() * found.back();
    fmt::print(
        "{:<28} {:5} scans  10 m: {:.3f} % {:.4f} deg/m  100 m: {:.3f} % {:.4f} deg/m ({})  "
        "end {:.2f} m  worst step {:.3f} m  {}  {:.1f} ms\n",
        name, truth.size(), ten.shift, ten.turn, hundred.shift, hundred.turn, hundred.pieces,
        (end.translation() - end_found.translation()).norm(), worst_step(truth, found), remarks,
        1e3 * static_cast<double>(clocks) / CLOCKS_PER_SEC / static_cast<double>(truth.size()));
}

}  // namespace dynamic_filter
