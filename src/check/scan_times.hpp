// SPDX-License-Identifier: MIT
/// When the points of scans were measured: ways to tell it, and which of them makes scans fit
/// together best at the poses of the recording.
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/check.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/settings.hpp"

namespace dynamic_filter::io {

/// [s] A longer step between scans means that scans were left out.
constexpr double kLongestSweep = 0.25;
/// [m] at a range of 10 m, by the motion during a scan; less does not matter.
constexpr double kLeastDistortion = 0.3;

/// Usual time [s] between scans.
double usual_step(const Recording& recording);

/// Ways in which a rotating sensor may have measured this scan: by the order of the points if they
/// show one, then by azimuths for both senses and four seams. Empty if the scan does not cover all
/// directions.
std::vector<Sweep> possible_sweeps(const Points& points, double duration);

/// What the poses of a recording say about the times of points.
struct TimesChoice {
    /// Set if scans overlay better with the motion during each scan undone, with these times; for
    /// points with times, it tells the shift.
    std::optional<Sweep> sweep;
    /// At the poses of the recording; `undone`: with the best times that were tried, 0 if none
    /// were.
    Blur blur;
};

/// Compares times at the poses of the recording, at places all over it: those of the fields, as
/// they are and with the stamp at their begin, middle or end; without fields, those of
/// possible_sweeps() with the stamp at each of these. Azimuths are tried only if the points show no
/// order, or if `asks_more`. Little is read if the sensor moves little during a scan.
TimesChoice choose_times(const Recording& recording, const OdometryConfig& config, bool asks_more);

}  // namespace dynamic_filter::io
