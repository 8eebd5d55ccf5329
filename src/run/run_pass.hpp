// SPDX-License-Identifier: MIT
/// What a run holds while it goes over the scans and reports.
#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "dynamic_filter/online.hpp"
#include "page/run_view.hpp"
#include "run/label_store.hpp"
#include "run/run_sequence.hpp"

namespace dynamic_filter::app {

/// Lives from the first pass over the scans to the reports.
struct Pass {
    io::Recording sequence;  ///< once all is filtered, with the poses that were found or refined
    const Config& config;
    const Pace& pace;
    const OutputFolder& output;
    StageClock& clock;
    const Watchers& watchers;
    const Extras& extras;
    RunSummary summary{};
    std::vector<bool> accepted = std::vector<bool>(sequence.size());
    std::vector<std::optional<Tracked>> tracked{};  ///< by scan; if poses are found or refined
    LabelStore instant{output.path()};              ///< verdicts of scans that are scored or shown
    std::vector<ScanNote> scan_notes{};
    std::optional<eval::ScanScores> scorer{};  ///< of final and instant verdicts, if there is truth
    Eigen::Vector3d scoring_origin = Eigen::Vector3d::Zero();
    std::mutex notices_lock{};
    std::vector<Notice> notices{};
    OnlineFilter filter{config, options(), callbacks()};  // the last: it uses the others

    /// Verdicts are written at the end, so nothing is forgotten.
    [[nodiscard]] OnlineOptions options() const {
        const bool drops = pace.online.value_or(0.0) > 0.0;
        return {.overload = drops ? Overload::drop_oldest : Overload::wait,
                .horizon = 0.0,
                .max_bytes = 0,
                .threads = pace.threads};
    }
    OnlineCallbacks callbacks() {
        return {.instant =
                    [this](const Verdict& verdict) {
                        tracked[verdict.index] = verdict.tracked;
                        if (sequence.info().has_truth() ||
                            (extras.report && is_shown(verdict.index, sequence.size()))) {
                            instant.put(verdict.index, verdict.labels);
                        }
                        if (watchers.live) {
                            watchers.live->feed().judged(verdict.index, verdict.labels,
                                                         verdict.tracked);
                        }
                    },
                .settled = {},
                .notice =
                    [this](const Notice& notice) {
                        const std::lock_guard hold(notices_lock);
                        notices.push_back(notice);
                    }};
    }
};

}  // namespace dynamic_filter::app
