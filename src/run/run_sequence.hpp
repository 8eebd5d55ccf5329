// SPDX-License-Identifier: MIT
/// A sequence through the filter into an output folder: what `run` and `demo` share.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/output_folder.hpp"
#include "base/stage_clock.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/scores.hpp"
#include "dynamic_filter/settings.hpp"
#include "page/live_view.hpp"

namespace dynamic_filter::app {

struct RunSummary {
    std::size_t scans = 0;  ///< that have a verdict
    std::vector<std::string> rejected;
    std::vector<std::string> dropped;  ///< online: what it could not keep up with
    std::vector<std::string> notes;
    std::size_t points = 0, still = 0, dynamic = 0, unknown = 0;
    MapContents contents;  ///< of the filter's maps
    Seconds seconds;       ///< of the whole process, until the reports were written
    /// Items per second of busy wall time, for each main stage in order.
    struct Rate {
        std::string stage, item;
        double per_second = 0.0;
    };
    std::vector<Rate> rates;
    std::optional<eval::Scores> scores, instant_scores;
    bool interrupted = false;
};

/// Receivers of progress while a run goes on.
struct Watchers {
    LiveView* live = nullptr;  ///< is told of every scan
    bool quiet = false;        ///< no progress on stderr
};

/// Outputs of a run beside labels and figures.
struct Extras {
    bool maps = true, report = true;
};

struct Pace {
    int threads = 0;               ///< 0: all cores
    std::optional<double> online;  ///< times the sensor's rate; 0: as fast as it can
};

/// Filters the sequence and writes everything a run leaves behind; `clock` is told of the stages.
/// Throws InputError if not a single scan is usable.
RunSummary run_sequence(const io::Recording& sequence, const Config& config, const Pace& pace,
                        const OutputFolder& output, StageClock& clock,
                        const Watchers& watchers = {}, const Extras& extras = {});

}  // namespace dynamic_filter::app
