// SPDX-License-Identifier: MIT
#include "check/continuity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "check/overlay.hpp"
#include "check/samples.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "recording/recording_parts.hpp"
#include "tracking/upright.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::size_t kAround = 10;  // scans before and after one, with which it is compared

/// What is usual for a value of the steps around one, without the nearest ones; 0 if not known.
struct Usual {
    double median = 0.0, quarter = 0.0;  ///< a quarter of the values are less than `quarter`
};
template <class Steps, class Value>
Usual usual(const Steps& steps, std::size_t at, const Value& value) {
    std::vector<double> values;
    const std::size_t begin = at > kAround ? at - kAround : 0;
    for (std::size_t i = begin; i < std::min(at + kAround + 1, steps.size()); ++i) {
        if (i + 1 >= at && i <= at + 1) continue;
        if (const std::optional<double> v = value(steps[i])) values.push_back(*v);
    }
    if (values.size() < kAround / 2) return {};
    std::sort(values.begin(), values.end());
    return {values[values.size() / 2], values[values.size() / 4]};
}

}  // namespace

ScanGist gist_of(const Points& points, const Pose& T_world_sensor) {
    constexpr std::size_t kMost = 30000;
    ScanGist gist{.points = 0, .upright = {}, .T_world_sensor = T_world_sensor};
    const std::size_t stride = points.size() / kMost + 1;
    Points some;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!is_measured(points[i])) continue;
        ++gist.points;
        if (i % stride == 0) some.push_back(points[i]);
    }
    gist.upright = upright_points(some);
    return gist;
}

void Continuity::add(std::size_t scan, ScanGist gist) {
    constexpr std::size_t kEnough = 200;  // points
    auto& [last, steps] = series_[sensors_.empty() ? 0 : sensors_[scan]];
    Step step{.scan = scan, .points = gist.points};
    const Pose way = last.T_world_sensor.inverse() * gist.T_world_sensor;
    step.way = way.translation().norm();
    step.is_comparable = !steps.empty() && follows(steps.back().scan, scan) &&
                         way.matrix().allFinite() &&
                         std::min(last.upright.size(), gist.upright.size()) > kEnough;
    if (step.is_comparable) step.overlay = overlay_of(last.upright, gist.upright, way);
    steps.push_back(step);
    last = std::move(gist);
}

/// True if the sensor made no scan between these two of its scans.
bool Continuity::follows(std::size_t last, std::size_t scan) const {
    if (sensors_.empty()) return scan == last + 1;
    const auto at = [&](std::size_t i) {
        return sensors_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    return std::find(at(last + 1), at(scan), sensors_[scan]) == at(scan);
}

std::vector<Alarm> Continuity::breaks() const {
    std::vector<Alarm> breaks;
    for (const auto& [sensor, series] : series_) find_breaks(series.steps, breaks);
    return breaks;
}

void Continuity::find_breaks(const std::vector<Step>& steps, std::vector<Alarm>& breaks) {
    constexpr double kClear = 0.4, kHalf = 0.5, kFarther = 2.0, kStride = 1.0;
    constexpr double kBelowMost = 0.6;  // of what a quarter of the neighbors fall below
    constexpr std::size_t kMost = 5;    // more do not tell more
    for (std::size_t i = 1; i < steps.size() && breaks.size() < kMost; ++i) {
        const Step& step = steps[i];
        const auto with = [](double Step::*value) {
            return [value](const Step& s) {
                return s.is_comparable ? std::optional(s.*value) : std::nullopt;
            };
        };
        const auto [overlay, low_overlay] = usual(steps, i, with(&Step::overlay));
        const double way = usual(steps, i, with(&Step::way)).median;
        const bool is_low =
            step.overlay < kHalf * overlay && step.overlay < kBelowMost * low_overlay;
        const bool is_break =
            step.is_comparable && overlay > kClear && is_low && step.way < kFarther * way + kStride;
        if (is_break) {
            breaks.push_back(
                {.what = fmt::format("by their poses the sensor went {:.1f} m from the first to "
                                     "the second, but they overlay by {:.0f} %, and their "
                                     "neighbors by {:.0f} %: the order of scans or poses is broken "
                                     "there, or a pose is wrong",
                                     step.way, 100.0 * step.overlay, 100.0 * overlay),
                 .advice = "check that the names of scans sort by time and that no scan or pose is "
                           "missing there",
                 .first = steps[i - 1].scan,
                 .last = step.scan,
                 .worst = step.scan});
        }
        const double points = usual(steps, i, [](const Step& s) {
                                  return std::optional(static_cast<double>(s.points));
                              }).median;
        const bool follows = i + 1 < steps.size();
        const auto is_short = [&](const Step& s) {
            return static_cast<double>(s.points) < kHalf * points;
        };
        if (is_short(step) && !is_short(steps[i - 1]) && follows && !is_short(steps[i + 1])) {
            breaks.push_back(
                {.what = fmt::format("it has {} points, the scans beside it about {:.0f}: a part "
                                     "of it is missing",
                                     step.points, points),
                 .advice = "copy the file again if it was cut off; the rest of it is used",
                 .first = step.scan,
                 .last = step.scan,
                 .worst = step.scan});
        }
    }
}

std::vector<Alarm> breaks_in(const Recording& recording) {
    constexpr std::size_t kPieces = 30, kPiece = 50;  // scans that follow each other
    std::vector<std::size_t> scans;
    const std::size_t step = std::max(recording.size() / kPieces, kPiece);
    for (std::size_t i = 0; i < recording.size(); ++i) {
        if (i % step < kPiece) scans.push_back(i);
    }
    std::vector<std::optional<ScanGist>> gists(scans.size());
    parallel_for(scans.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            try {
                const FullScan scan = recording.read(scans[k]);
                gists[k] = gist_of(scan.points, scan.T_world_sensor);
            } catch (const InputError&) {  // is named as unusable
            }
        }
    });
    Continuity continuity(recording.parts().sensors);
    for (std::size_t k = 0; k < scans.size(); ++k) {
        if (gists[k]) continuity.add(scans[k], *std::move(gists[k]));
    }
    return continuity.breaks();
}

}  // namespace dynamic_filter::io
