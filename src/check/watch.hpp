// SPDX-License-Identifier: MIT
/// The watch on a result: finds what a run over a sound recording does not do, such as removing the
/// ground.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/check.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// What is looked at in one scan with its final labels.
struct ScanWatch {
    std::size_t scan = 0;                     ///< index in the recording
    std::size_t points = 0;                   ///< that are measured
    std::size_t dynamic = 0, unknown = 0;     ///< of those
    std::size_t ground = 0, ground_gone = 0;  ///< parts of the ground, 0.25 m2; the dynamic ones
};

/// `points` are in the sensor frame, `labels` parallel to them. The ground is what lies lowest,
/// seen from above, in large areas without steps.
ScanWatch watch_scan(std::size_t scan, const Points& points, const Pose& T_world_sensor,
                     const Labels& labels);

/// A fault of a result.
struct Alarm {
    std::string what{};    ///< what was removed or left undecided, with the measured values
    std::string advice{};  ///< what to do; complete after explain()
    std::size_t first = 0, last = 0;  ///< indices of the scans
    std::size_t worst = 0;            ///< index of the scan that shows it best
};

/// Scans that lose much of their ground; those that show little of it are taken together. Empty for
/// a sound result.
std::optional<Alarm> ground_alarm(std::span<const ScanWatch> scans);
/// The faults of a result; empty for a sound one.
std::vector<Alarm> alarms_of(std::span<const ScanWatch> scans);

/// Where the poses of a run are from.
enum class PosesFrom { given, refined, found };

/// Looks at the scans around the worst one, and adds to the alarm what makes them overlay better,
/// and what to do. `used`: with the poses and times of the run.
Alarm explain(Alarm alarm, const Recording& used, PosesFrom from, const OdometryConfig& config);

/// "scans 000012 to 000040: ..."
std::string to_text(const Alarm& alarm, const Recording& recording);

}  // namespace dynamic_filter::io
