// SPDX-License-Identifier: MIT
#include "run_sequence.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numeric>
#include <thread>

#include "config_file.hpp"
#include "dynamic_filter/dynamic_filter.hpp"
#include "frames.hpp"
#include "map_files.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "view/run_view.hpp"

namespace dynamic_filter::app {

namespace {

using Clock = std::chrono::steady_clock;

/// What lives from the first pass over the scans to the reports.
struct Pass {
    const io::Sequence& sequence;
    const Config& config;
    const Pace& pace;
    const OutputFolder& output;
    const Watchers& watchers;
    RunSummary summary{};
    std::vector<bool> accepted = std::vector<bool>(sequence.size());
    std::vector<Labels> instant{};  ///< by scan; of those that are scored or shown
    std::vector<ScanNote> scan_notes{};
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
                        if (sequence.has_truth() || is_shown(verdict.index, sequence.size())) {
                            instant[verdict.index] = verdict.labels;
                        }
                        if (watchers.live) {
                            watchers.live->feed().judged(verdict.index, verdict.labels);
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

std::vector<std::size_t> all_scans(const io::Sequence& sequence) {
    std::vector<std::size_t> scans(sequence.size());
    std::iota(scans.begin(), scans.end(), std::size_t{0});
    return scans;
}

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

/// What the filter said about scans, into the summary.
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
    const double due = (stamp - pass.sequence.stamps.front()) / speed;
    while (!interrupted()) {
        const double left = due - seconds_since(start);
        if (left <= 0.0) return;
        std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left, 0.1)));
    }
}

/// First pass: every usable scan goes through the filter.
void filter_scans(Pass& pass) {
    Progress progress("filter", pass.sequence.size());
    pass.instant.resize(pass.sequence.size());
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
    const bool none =
        std::find(pass.accepted.begin(), pass.accepted.end(), true) == pass.accepted.end();
    if (none && !pass.summary.interrupted) {
        throw InputError(
            pass.sequence.root, "",
            "no scan is usable; the first was rejected: " + pass.summary.rejected.front());
    }
}

void note(Pass& pass, std::size_t i, const io::Frame& frame, const Labels& labels) {
    ScanNote note = note_of(labels, pass.instant[i], frame.truth);
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
    const auto folder = pass.output.subfolder("labels");
    MapFiles maps(pass.output.path(), pass.config.output.keep_unknown,
                  pass.sequence.format == io::Format::benchmark);
    const std::vector<std::size_t> scans = accepted_scans(pass);
    Progress progress("write", scans.size());
    std::vector<Labels> labels(pass.sequence.size());
    const auto classify = [&](std::size_t i, MaybeFrame& maybe) {
        const io::Frame& frame = *maybe.frame;
        labels[i] =
            pass.filter.verdict({frame.points, frame.T_world_sensor, frame.stamp, i}).labels;
        io::write_labels(folder / (io::stem(pass.sequence, i) + ".label"), labels[i]);
    };
    const auto use = [&](std::size_t i, MaybeFrame& maybe) {
        if (!maybe.frame) {
            throw InputError(pass.sequence.scan_files[i], "",
                             "changed while it was in use: " + maybe.error);
        }
        maps.append(*maybe.frame, labels[i]);
        note(pass, i, *maybe.frame, labels[i]);
        if (pass.watchers.from_above) {
            pass.watchers.from_above->add(shifted_world(*maybe.frame, Eigen::Vector3d::Zero()),
                                          labels[i]);
        }
        if (pass.watchers.live) {
            pass.watchers.live->feed().corrected(i, maybe.frame->points, labels[i]);
        }
        labels[i] = {};
        progress.advance();
        return true;  // what is filtered is written even after an interruption; a second one kills
    };
    for_each_frame(pass.sequence, scans, classify, use);
    maps.commit();
}

void score(Pass& pass) {
    constexpr double voxel = eval::kVoxelSize;
    const Eigen::Vector3d origin = scoring_origin(pass.sequence, voxel);
    const auto folder = pass.output.path() / "labels";
    const auto final_labels = [&](std::size_t i) -> std::optional<Labels> {
        const auto file = folder / (io::stem(pass.sequence, i) + ".label");
        if (!std::filesystem::exists(file)) return std::nullopt;
        return io::read_labels(file);
    };
    const auto instant_labels = [&](std::size_t i) -> std::optional<Labels> {
        if (pass.instant[i].empty()) return std::nullopt;
        return pass.instant[i];
    };
    const std::size_t n = pass.sequence.size();
    pass.summary.scores =
        eval::score_labels(n, scan_source(pass.sequence, origin, final_labels), voxel);
    pass.summary.instant_scores =
        eval::score_labels(n, scan_source(pass.sequence, origin, instant_labels), voxel);
}

double total(const StageTimes& times, const std::string& stage) {
    const auto it = times.find(stage);
    return it == times.end() ? 0.0 : it->second.total();
}

double rate(std::size_t items, double seconds) {
    return seconds > 0 ? static_cast<double>(items) / seconds : 0.0;
}

nlohmann::ordered_json timing(const Pass& pass, double cpu_seconds, long peak_rss) {
    const RunSummary& s = pass.summary;
    const int threads = pass.pace.threads;
    nlohmann::ordered_json json{
        {"scans_per_second", rate(s.scans, s.seconds)},
        {"cpu_seconds", cpu_seconds},
        {"front_end", {{"scans_per_second", s.front_end_scans_per_second}}},
        {"back_end", {{"submaps_per_second", s.back_end_submaps_per_second}}},
        {"stages", to_json(pass.filter.times())},
        {"voxels", s.voxels},
        {"peak_rss_bytes", peak_rss},
        {"threads", threads > 0 ? threads : available_threads()}};
    if (pass.pace.online) {
        const Counters c = pass.filter.counters();
        json["online"] = {{"speed", *pass.pace.online}, {"in", c.in},
                          {"processed", c.processed},   {"dropped", c.dropped},
                          {"rejected", c.rejected},     {"queued", c.queued}};
    }
    return json;
}

nlohmann::ordered_json metrics(const Pass& pass) {
    const RunSummary& s = pass.summary;
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    if (s.scores) json = to_json(*s.scores);
    if (s.instant_scores) json["instant"] = to_json(*s.instant_scores);
    if (s.scores) json["voxel_size"] = eval::kVoxelSize;
    json["scans"] = s.scans;
    json["points"] = {{"static", s.still}, {"dynamic", s.dynamic}, {"unknown", s.unknown}};
    json["rejected"] = s.rejected;
    json["dropped"] = s.dropped;
    json["lost"] = pass.sequence.losses;
    return json;
}

void write_log(const Pass& pass) {
    std::string log = fmt::format("input    {} ({}, {} scans)\n", pass.sequence.root.string(),
                                  io::to_string(pass.sequence.format), pass.sequence.size());
    for (const std::string& note : pass.sequence.notes) log += "note     " + note + "\n";
    for (const std::string& note : pass.summary.notes) log += "note     " + note + "\n";
    for (const std::string& line : pass.sequence.losses) log += "lost     " + line + "\n";
    for (const std::string& line : pass.summary.rejected) log += "rejected " + line + "\n";
    for (const std::string& line : pass.summary.dropped) log += "dropped  " + line + "\n";
    if (const auto beams = pass.filter.extent().beams) {
        log += fmt::format("beams    {:.2f} deg along azimuth, {:.2f} deg along elevation\n",
                           beams->azimuth_spacing * 180.0 / M_PI,
                           beams->elevation_spacing * 180.0 / M_PI);
    }
    if (pass.summary.interrupted) log += "interrupted: only the scans filtered so far are here\n";
    io::write_file(pass.output.path() / "run.log", log + to_text(pass.summary));
}

nlohmann::ordered_json measure(Pass& pass, Clock::time_point start) {
    RunSummary& s = pass.summary;
    s.seconds = seconds_since(start);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    const OnlineFilter::Extent extent = pass.filter.extent();
    const StageTimes times = pass.filter.times();
    s.submaps = extent.submaps;
    s.voxels = extent.voxels;
    s.front_end_scans_per_second = rate(s.scans, total(times, "front_end"));
    s.back_end_submaps_per_second = rate(s.submaps, total(times, "back_end"));
    return timing(pass, seconds(usage.ru_utime) + seconds(usage.ru_stime), 1024 * usage.ru_maxrss);
}

void describe(PageRun& run, const Pass& pass) {
    run.info["name"] = pass.output.name().filename().string();
    run.info["command"] = "run";
    run.info["version"] = DYNAMIC_FILTER_VERSION;
    run.info["input"] = pass.sequence.root.string();
    run.info["format"] = io::to_string(pass.sequence.format);
    run.info["created"] = fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)));
    for (const char* name : {"default", "paper"}) {
        if (to_toml(pass.config) == to_toml(preset(name))) run.info["preset"] = name;
    }
    run.info["voxel_size"] = pass.config.back_end.voxel_size;
    run.info["keyframes_total"] = pass.filter.extent().keyframes_total;
    run.info["config"] = to_toml(pass.config);
    const RunSummary& s = pass.summary;
    run.info["counts"] = {{"static", s.still}, {"dynamic", s.dynamic}, {"unknown", s.unknown}};
    run.info["notes"] = pass.sequence.notes;
    for (const std::string& note : s.notes) run.info["notes"].push_back(note);
    run.info["rejected"] = s.rejected;
    run.info["dropped"] = s.dropped;
}

/// The page that explains the result. What its writing took goes into `timing`.
void write_report(Pass& pass, const nlohmann::ordered_json& metrics,
                  nlohmann::ordered_json& timing) {
    if (viewer_page().empty()) {
        pass.summary.notes.emplace_back(
            "no report.html: built without the viewer (npm was missing)");
        return;
    }
    const auto start = Clock::now();
    const bool has_evidence =
        pass.config.back_end.enabled && pass.config.back_end.observers == Observers::scans;
    PageRun run = view_of({pass.sequence, pass.filter, pass.scan_notes, pass.instant,
                           pass.output.path() / "labels", has_evidence});
    describe(run, pass);
    run.info["scores"] = metrics;
    run.info["timing"] = timing;
    const std::string text = embedded(run, 0);
    io::write_file(pass.output.path() / "report.html", page_with({&text, 1}));
    timing["report_seconds"] = seconds_since(start);
}

}  // namespace

RunSummary run_sequence(const io::Sequence& sequence, const Config& config, const Pace& pace,
                        const OutputFolder& output, const Watchers& watchers) {
    RunSummary summary;
    with_threads(pace.threads, [&] {
        const auto start = Clock::now();
        Pass pass{sequence, config, pace, output, watchers};
        io::write_file(output.path() / "config.toml", to_toml(config));
        filter_scans(pass);
        write_results(pass);
        nlohmann::ordered_json timing = measure(pass, start);
        pass.summary.interrupted |= interrupted();
        if (sequence.has_truth() && !pass.summary.interrupted) score(pass);
        const nlohmann::ordered_json metrics = app::metrics(pass);
        write_report(pass, metrics, timing);
        io::write_file(output.path() / "metrics.json", text_of(metrics));
        io::write_file(output.path() / "timing.json", text_of(timing));
        write_log(pass);
        summary = std::move(pass.summary);
    });
    return summary;
}

std::string to_text(const RunSummary& s) {
    const auto share = [&](std::size_t n) {
        return s.points == 0 ? 0.0 : 100.0 * static_cast<double>(n) / static_cast<double>(s.points);
    };
    std::string text =
        fmt::format("scans    {} ({} rejected) in {} submaps, {} voxels\n", s.scans,
                    s.rejected.size(), s.submaps, s.voxels) +
        fmt::format("points   {}: {:.1f} % static, {:.1f} % dynamic, {:.1f} % unknown\n", s.points,
                    share(s.still), share(s.dynamic), share(s.unknown)) +
        fmt::format(
            "speed    {:.1f} scans/s over all; front-end {:.1f} scans/s, back-end {:.1f} "
            "submaps/s\n",
            rate(s.scans, s.seconds), s.front_end_scans_per_second, s.back_end_submaps_per_second);
    if (s.scores) text += "scores against the ground truth of the recording\n" + table(*s.scores);
    return text;
}

}  // namespace dynamic_filter::app
