// SPDX-License-Identifier: MIT
/// What a run found in one recording, and how it tells it: metrics.json, run.log, timing.json and
/// the console. The two ways to filter (filter_whole.hpp, filter_tile.hpp) fill the same summary.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/stage_clock.hpp"
#include "check/watch.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/scores.hpp"
#include "run/remarks.hpp"
#include "run/write_scans.hpp"

namespace dynamic_filter::app {

struct RunSummary {
    std::size_t scans = 0;       ///< that have a verdict
    std::size_t with_truth = 0;  ///< those of them that have ground truth
    Remarks remarks;
    std::vector<io::Alarm> alarms;  ///< those of the remarks, with their scans
    std::size_t points = 0, still = 0, dynamic = 0, unknown = 0;
    MapContents contents;  ///< of the filter's maps; empty if tiles were filtered
    Seconds seconds;       ///< of the whole process, until the reports were written
    /// Items per second of busy wall time, for each main stage in order.
    struct Rate {
        std::string stage, item;
        double per_second = 0.0;
    };
    std::vector<Rate> rates;
    std::optional<eval::Scores> scores, instant_scores;
    bool interrupted = false;

    /// Counts a scan with these final labels. `truth`: empty without ground truth.
    void count(const Labels& labels, const Labels& truth);
    void add_alarm(const io::Alarm& alarm, const io::Recording& recording);
    /// Adds what the watch finds in the result.
    void add_watch(const WrittenScans& written, const io::Recording& recording, io::PosesFrom from,
                   const OdometryConfig& config);
};

/// The scans that cannot be used.
InputError no_scan_is_usable(const io::Recording& recording, const Remarks& remarks);

/// metrics.json.
nlohmann::ordered_json metrics_of(const RunSummary& summary);
/// run.log but for its closing lines.
std::string log_of(const io::Recording& recording, const RunSummary& summary);
/// timing.json as far as all runs have it.
nlohmann::ordered_json timing_of(std::size_t scans, const StageClock& clock, int threads);

/// "12 scans (1 rejected); 345 points: 90.0 % static, ..."
std::string points_text(const RunSummary& summary);
/// The table of the scores; empty without ground truth.
std::string scores_text(const RunSummary& summary);
/// The closing lines of a recording that was filtered in memory.
std::string to_text(const RunSummary& summary);

}  // namespace dynamic_filter::app
