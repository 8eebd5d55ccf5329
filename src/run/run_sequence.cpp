// SPDX-License-Identifier: MIT
#include "run/run_sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <thread>
#include <utility>

#include "base/progress.hpp"
#include "check/motion.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/parallel.hpp"
#include "recording/frames.hpp"
#include "run/run_reports.hpp"
#include "run/scored_scans.hpp"
#include "run/write_scans.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

using Clock = std::chrono::steady_clock;

std::vector<std::size_t> accepted_scans(const Pass& pass) {
    std::vector<std::size_t> scans;
    for (std::size_t i = 0; i < pass.accepted.size(); ++i) {
        if (pass.accepted[i]) scans.push_back(i);
    }
    return scans;
}

void reject(Pass& pass, std::size_t i, const std::string& why) {
    pass.summary.rejected.push_back(fmt::format("{}: {}", io::stem(pass.sequence, i), why));
}

/// Puts the filter's notices about scans into the summary.
void take_notices(Pass& pass) {
    for (const Notice& notice : pass.notices) {
        const std::string line =
            fmt::format("{}: {}", io::stem(pass.sequence, notice.index), notice.text);
        if (notice.kind == NoticeKind::jump || notice.kind == NoticeKind::restart) {
            pass.summary.notes.push_back(line);
            continue;
        }
        pass.accepted[notice.index] = false;
        (notice.kind == NoticeKind::dropped ? pass.summary.dropped : pass.summary.rejected)
            .push_back(line);
    }
}

/// Waits until the sensor would have sent the scan.
void keep_pace(const Pass& pass, Clock::time_point start, double stamp) {
    const double speed = pass.pace.online.value_or(0.0);
    if (speed <= 0.0) return;
    const double due = (stamp - pass.sequence.info().stamps.front()) / speed;
    while (!interrupted()) {
        const double left = due - seconds_since(start);
        if (left <= 0.0) return;
        std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left, 0.1)));
    }
}

/// The poses that were found or refined are the recording's from now on.
void take_poses(Pass& pass) {
    const auto was_tracked = [](const auto& tracked) { return tracked.has_value(); };
    if (std::none_of(pass.tracked.begin(), pass.tracked.end(), was_tracked)) return;
    pass.sequence = io::with_poses(pass.sequence, pass.tracked);
    write_poses(pass.output.path() / "poses.txt", pass.sequence);
    pass.summary.notes.push_back(track_text(pass.tracked));
}

/// First pass: every usable scan goes through the filter.
void filter_scans(Pass& pass) {
    Progress progress("filter", pass.sequence.size(), pass.watchers.quiet);
    pass.tracked.resize(pass.sequence.size());
    std::vector<io::Field> fields;
    std::optional<Clock::time_point> start;
    const auto use = [&](std::size_t i, MaybeFrame& maybe) {
        if (!start) start = Clock::now();
        if (!maybe.frame) {
            reject(pass, i, maybe.error);
        } else if (!fields.empty() && maybe.frame->cloud.fields != fields) {
            reject(pass, i, io::kOtherFields);
        } else {
            if (fields.empty()) fields = maybe.frame->cloud.fields;
            pass.accepted[i] = true;
            if (!maybe.frame->truth_fault.empty()) {
                pass.summary.notes.push_back(maybe.frame->truth_fault +
                                             "; the scan is filtered, but not scored");
            }
            keep_pace(pass, *start, maybe.frame->stamp);
            if (pass.watchers.live) {
                pass.watchers.live->feed().expect(maybe.frame->points, maybe.frame->T_world_sensor,
                                                  maybe.frame->stamp, i);
            }
            pass.filter.push(take_scan(*maybe.frame, i));
        }
        progress.advance();
        return !(pass.summary.interrupted = interrupted());
    };
    for_each_frame(pass.sequence, all_scans(pass.sequence), {}, use);
    pass.filter.finish();
    take_notices(pass);
    take_poses(pass);
    const bool none =
        std::find(pass.accepted.begin(), pass.accepted.end(), true) == pass.accepted.end();
    if (none && !pass.summary.interrupted) {
        throw InputError(
            pass.sequence.info().root, "",
            "no scan is usable; the first was rejected: " + pass.summary.rejected.front());
    }
}

void note(Pass& pass, std::size_t i, const io::FullScan& frame, const Labels& labels,
          const Labels& instant) {
    ScanNote note = note_of(labels, instant, frame.truth);
    note.index = i;
    note.position = frame.T_world_sensor.translation();
    note.stamp = frame.stamp;
    RunSummary& summary = pass.summary;
    ++summary.scans;
    summary.points += labels.size();
    summary.still += note.counts[0];
    summary.dynamic += note.counts[1];
    summary.unknown += note.counts[2];
    pass.scan_notes.push_back(note);
}

/// Second pass: final verdicts, label files, maps.
void write_results(Pass& pass) {
    const std::vector<std::size_t> scans = accepted_scans(pass);
    Progress progress("write", scans.size(), pass.watchers.quiet);
    if (pass.sequence.info().has_truth()) {
        pass.scorer.emplace(eval::kVoxelSize, 2);
        pass.scoring_origin = scoring_origin(pass.sequence, eval::kVoxelSize);
    }
    const auto decide = [&](std::size_t i, const io::FullScan& frame) {
        return pass.filter.verdict({frame.points, frame.T_world_sensor, frame.stamp, i});
    };
    const auto use = [&](std::size_t i, const io::FullScan& frame, const Verdict& verdict) {
        const Labels instant = pass.instant.get(i);
        if (pass.scorer && !frame.truth.empty()) {
            pass.scorer->add(labelled(frame, pass.scoring_origin),
                             std::array<const Labels*, 2>{&verdict.labels, &instant});
        }
        note(pass, i, frame, verdict.labels, instant);
        if (pass.watchers.live) {
            pass.watchers.live->feed().corrected(i, frame.points, verdict.labels);
        }
        progress.advance();
    };
    write_scans(pass.sequence, scans, pass.config, pass.extras.maps, pass.output.path(),
                {.decide = decide, .use = use});
}

/// Third pass, over recordings with ground truth: which removed points lie near one that stays.
/// While the scans were written, all else was counted.
void score(Pass& pass) {
    const auto folder = pass.output.path() / "labels";
    std::vector<std::vector<Points>> near(pass.sequence.size());
    const auto find = [&](std::size_t i, MaybeFrame& maybe) {
        if (maybe.frame->truth.empty()) return;
        const Labels labels = io::read_labels(folder / (io::stem(pass.sequence, i) + ".label"));
        const Labels instant = pass.instant.get(i);
        near[i] = pass.scorer->near_removed(labelled(*maybe.frame, pass.scoring_origin),
                                            std::array<const Labels*, 2>{&labels, &instant});
    };
    const auto use = [&](std::size_t i, MaybeFrame&) {
        if (!near[i].empty()) pass.scorer->add_near(std::exchange(near[i], {}));
        return true;  // half of it would be wrong scores; a second interruption kills
    };
    for_each_frame(pass.sequence, accepted_scans(pass), find, use);
    pass.summary.scores = pass.scorer->scores(0);
    pass.summary.instant_scores = pass.scorer->scores(1);
}

}  // namespace

RunSummary run_sequence(const io::Recording& sequence, const Config& config, const Pace& pace,
                        const OutputFolder& output, StageClock& clock, const Watchers& watchers,
                        const Extras& extras) {
    RunSummary summary;
    with_threads(pace.threads, [&] {
        Pass pass{sequence, config, pace, output, clock, watchers, extras};
        io::write_file(output.path() / "config.toml", to_toml(config));
        filter_scans(pass);
        clock.finish("filter");
        write_results(pass);
        clock.finish("write");
        pass.summary.interrupted |= interrupted();
        if (pass.scorer && !pass.summary.interrupted) {
            score(pass);
            clock.finish("score");
        }
        write_reports(pass);
        summary = std::move(pass.summary);
    });
    return summary;
}

}  // namespace dynamic_filter::app
