// SPDX-License-Identifier: MIT
#include "run/filter_whole.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "base/progress.hpp"
#include "check/motion.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/parallel.hpp"
#include "formats/label_files.hpp"
#include "objects/object_log.hpp"
#include "objects/object_ways.hpp"
#include "online/maps.hpp"
#include "online/scan_queue.hpp"
#include "online/scan_worker.hpp"
#include "page/page.hpp"
#include "page/run_view.hpp"
#include "recording/scans.hpp"
#include "run/label_store.hpp"
#include "run/placed.hpp"
#include "run/scored_scans.hpp"
#include "run/write_scans.hpp"
#include "score/report.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

/// Lives from the first reading of the scans to the reports.
struct Whole {
    Job& job;
    const RunOptions& o;
    const OutputFolder& output;
    StageClock& clock;
    LiveView* live;
    io::Recording& recording = job.drives.front().recording;
    RunSummary summary{};
    std::vector<bool> accepted = std::vector<bool>(recording.size());
    std::vector<std::optional<Tracked>> tracked{};  ///< by scan; if poses are found or refined
    LabelStore instant{output.path()};              ///< verdicts of scans that are scored or shown
    std::vector<ScanNote> scan_notes{};
    std::vector<std::string> sensors{};  // names by ScanNote::sensor
    std::optional<ShownScans> shown{};   ///< if there is a page
    ObjectWays ways{};                   ///< of what moves, if there is a page
    ObjectLog objects{[this](const KnownScan& scan) { ways.add(scan); }};
    std::optional<eval::ScanScores> scorer{};  ///< of final and instant verdicts, if there is truth
    Eigen::Vector3d scoring_origin = Eigen::Vector3d::Zero();
    std::vector<Notice> notices{};
    Maps maps{job.config, limits()};
    ScanQueue queue{};          ///< refuses what cannot be judged; scans do not wait in it
    std::uint64_t stretch = 0;  ///< of the scan before
    /// With --online: takes the scans, and judges them in a thread of its own.
    std::optional<ScanWorker> worker{};

    /// Verdicts are written at the end, so nothing is forgotten.
    [[nodiscard]] OnlineOptions limits() const {
        return {.overload = o.speed > 0.0 ? Overload::drop_oldest : Overload::wait,
                .horizon = 0.0,
                .max_bytes = 0,
                .threads = o.threads};
    }
    OnlineCallbacks callbacks() {
        return {.instant = [this](const Verdict& verdict) { keep(verdict); },
                .settled = {},
                .notice = [this](const Notice& notice) { notices.push_back(notice); }};
    }
    void keep(const Maps::Judged& judged) {
        if (judged.notice) notices.push_back(*judged.notice);
        for (const Verdict& verdict : judged.instant) keep(verdict);
    }
    void keep(const Verdict& verdict) {
        tracked[verdict.index] = verdict.tracked;
        const bool is_wanted =
            recording.info().has_truth() || (o.report && is_shown(verdict.index, recording.size()));
        if (is_wanted) instant.put(verdict.index, verdict.labels);
        if (live) live->feed().judged(verdict.index, verdict.labels, verdict.tracked);
    }
};

void push(Whole& whole, Scan scan) {
    if (whole.worker) return whole.worker->push(std::move(scan));
    auto passed = whole.queue.pass(std::move(scan));
    if (const auto* const refused = std::get_if<Notice>(&passed)) {
        whole.notices.push_back(*refused);
        return;
    }
    auto& next = std::get<QueuedScan>(passed);
    const std::size_t index = next.scan.index;
    const auto& tracked = whole.job.tracked;
    const bool is_lost = !tracked.empty() && tracked[index] && tracked[index]->begins_anew;
    const bool restarts = std::exchange(whole.stretch, next.stretch) != next.stretch;
    const auto follows = restarts  ? Maps::Follows::restarts
                         : is_lost ? Maps::Follows::lost
                                   : Maps::Follows::on;
    whole.keep(whole.maps.judge(std::move(next.scan), follows));
    whole.maps.catch_up();
}

void finish(Whole& whole) {
    if (whole.worker) return whole.worker->finish();
    whole.keep(whole.maps.finish());
}

std::vector<std::size_t> accepted_scans(const Whole& whole) {
    std::vector<std::size_t> scans;
    for (std::size_t i = 0; i < whole.accepted.size(); ++i) {
        if (whole.accepted[i]) scans.push_back(i);
    }
    return scans;
}

void reject(Whole& whole, std::size_t i, const std::string& why) {
    whole.summary.remarks.push_back(
        {RemarkKind::rejected, fmt::format("{}: {}", io::stem(whole.recording, i), why)});
}

/// Puts the filter's notices about scans into the summary.
void add_notices(Whole& whole) {
    for (const Notice& notice : whole.notices) {
        const std::string line =
            fmt::format("{}: {}", io::stem(whole.recording, notice.index), notice.text);
        if (notice.kind == NoticeKind::jump || notice.kind == NoticeKind::restart) {
            whole.summary.remarks.push_back({RemarkKind::note, line});
            continue;
        }
        whole.accepted[notice.index] = false;
        const bool is_dropped = notice.kind == NoticeKind::dropped;
        whole.summary.remarks.push_back(
            {is_dropped ? RemarkKind::dropped : RemarkKind::rejected, line});
    }
}

/// Waits until the sensor would have sent the scan.
void keep_pace(const Whole& whole, Clock::time_point start, double stamp) {
    const double speed = (whole.o.online ? whole.o.speed : 0.0);
    if (speed <= 0.0) return;
    const double due = (stamp - whole.recording.info().stamps.front()) / speed;
    while (!interrupted()) {
        const double left = due - seconds_since(start);
        if (left <= 0.0) return;
        std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left, 0.1)));
    }
}

/// The poses that were found or refined are the recording's from now on.
void use_poses(Whole& whole) {
    if (!whole.job.tracked.empty()) {
        write_poses(whole.output.path() / "poses.txt", whole.recording);
        return;
    }
    const auto was_tracked = [](const auto& tracked) { return tracked.has_value(); };
    if (std::none_of(whole.tracked.begin(), whole.tracked.end(), was_tracked)) return;
    const std::size_t known = whole.recording.info().losses.size();
    Remarks& remarks = whole.summary.remarks;
    remarks.push_back({RemarkKind::note, use_track(whole.recording, whole.tracked)});
    add(remarks, RemarkKind::lost, std::span(whole.recording.info().losses).subspan(known));
    write_poses(whole.output.path() / "poses.txt", whole.recording);
}

/// First reading: every usable scan goes through the filter.
void filter_scans(Whole& whole) {
    Progress progress("filter", whole.recording.size(), whole.o.quiet);
    whole.tracked.resize(whole.recording.size());
    std::vector<io::Field> fields;
    std::optional<Clock::time_point> start;
    const auto use = [&](std::size_t i, MaybeScan& maybe) {
        if (!start) start = Clock::now();
        if (!maybe.scan) {
            reject(whole, i, maybe.error);
        } else if (!fields.empty() && maybe.scan->cloud.fields != fields) {
            reject(whole, i, io::kOtherFields);
        } else {
            if (fields.empty()) fields = maybe.scan->cloud.fields;
            whole.accepted[i] = true;
            if (!maybe.scan->truth_fault.empty()) {
                whole.summary.remarks.push_back(
                    {RemarkKind::note,
                     maybe.scan->truth_fault + "; the scan is filtered, but not scored"});
            }
            keep_pace(whole, *start, maybe.scan->stamp);
            if (whole.live) {
                whole.live->feed().expect(maybe.scan->points, maybe.scan->T_world_sensor,
                                          maybe.scan->stamp, i);
            }
            push(whole, moved_scan(*maybe.scan, i));
        }
        progress.advance();
        return !(whole.summary.interrupted = interrupted());
    };
    for_each_scan(whole.recording, all_scans(whole.recording), {}, use);
    finish(whole);
    add_notices(whole);
    use_poses(whole);
    write_placed(whole.output.path(),
                 placed_of(whole.recording, whole.o.data, whole.job.fingerprints.front()));
    const bool none =
        std::find(whole.accepted.begin(), whole.accepted.end(), true) == whole.accepted.end();
    if (none && !whole.summary.interrupted) {
        throw no_scan_is_usable(whole.recording, whole.summary.remarks);
    }
}

/// What the page and the scores need of a scan.
struct SeenScan {
    Labels instant{};
    ScanNote note{};
    ShownScans::Drawn drawn{};
    std::vector<Eigen::Vector3d> moving{};  ///< [m] places in the world, for the page
};

SeenScan see(const Whole& whole, std::size_t i, const io::FullScan& scan, const Labels& labels) {
    SeenScan seen{.instant = whole.instant.get(i)};
    seen.note = note_of(labels, seen.instant, scan.truth);
    seen.note.index = i;
    seen.note.sensor = scan.sensor;
    seen.note.position = scan.T_world_sensor.translation();
    seen.note.stamp = scan.stamp;
    if (!whole.shown) return seen;
    const bool has_intensity = !whole.recording.info().intensity_is_truth;
    seen.drawn = whole.shown->draw(i, scan, labels, seen.instant,
                                   has_intensity ? intensities(scan.cloud) : std::vector<double>{});
    seen.moving = places_at(scan.points, moving_points(scan.points, labels), scan.T_world_sensor);
    return seen;
}

io::PosesFrom poses_from(const Whole& whole) {
    if (!whole.job.tracked.empty()) {
        return whole.job.has_given_poses ? io::PosesFrom::refined : io::PosesFrom::found;
    }
    const bool were_tracked = std::any_of(whole.tracked.begin(), whole.tracked.end(),
                                          [](const auto& t) { return t.has_value(); });
    if (!were_tracked) return io::PosesFrom::given;
    return whole.job.config.odometry.refine ? io::PosesFrom::refined : io::PosesFrom::found;
}

/// Second reading: final verdicts, label files, maps, and what the page shows.
void write_results(Whole& whole) {
    const std::vector<std::size_t> scans = accepted_scans(whole);
    Progress progress("write", scans.size(), whole.o.quiet);
    if (whole.recording.info().has_truth()) {
        whole.scorer.emplace(eval::kVoxelSize, 2);
        whole.scoring_origin = scoring_origin(whole.recording, eval::kVoxelSize);
    }
    const auto decide = [&](std::size_t i, const io::FullScan& scan) {
        return whole.maps.verdict({scan.points, scan.T_world_sensor, scan.stamp, i});
    };
    const auto places_of = [&](const Scan& scan) { return whole.maps.places_of(scan); };
    if (whole.o.report && !viewer_page().empty()) {
        whole.shown.emplace(scans, whole.recording.size(), places_of);
    }
    std::vector<SeenScan> seen(whole.recording.size());
    const auto look = [&](std::size_t i, const io::FullScan& scan, const Labels& labels) {
        seen[i] = see(whole, i, scan, labels);
    };
    const auto use = [&](std::size_t i, const io::FullScan& scan, const Verdict& verdict) {
        SeenScan of_scan = std::exchange(seen[i], {});
        if (whole.shown) {
            whole.shown->add(i, std::move(of_scan.drawn));
            whole.objects.add(i, scan.stamp, std::move(of_scan.moving));
        }
        if (whole.scorer && !scan.truth.empty()) {
            whole.scorer->add(labelled(scan, whole.scoring_origin),
                              std::array<const Labels*, 2>{&verdict.labels, &of_scan.instant});
        }
        whole.summary.count(verdict.labels, scan.truth);
        whole.scan_notes.push_back(of_scan.note);
        whole.sensors.resize(std::max(whole.sensors.size(), scan.sensor + 1));
        whole.sensors[scan.sensor] = scan.sensor_name;
        if (whole.live) {
            whole.live->feed().corrected(i, scan.points, verdict.labels);
        }
        progress.advance();
    };
    const WrittenScans written =
        write_scans(whole.recording, scans, whole.job.config, whole.o.maps, whole.output.path(),
                    {.decide = decide, .look = look, .use = use});
    whole.summary.add_watch(written, whole.recording, poses_from(whole), whole.job.config.odometry);
}

/// Third reading, over recordings with ground truth: which removed points lie near one that stays.
/// While the scans were written, all else was counted.
void score(Whole& whole) {
    const auto folder = whole.output.path() / "labels";
    std::vector<std::vector<Points>> near(whole.recording.size());
    const auto find = [&](std::size_t i, MaybeScan& maybe) {
        if (maybe.scan->truth.empty()) return;
        const Labels labels = io::read_labels(io::label_file(folder, io::stem(whole.recording, i)));
        const Labels instant = whole.instant.get(i);
        near[i] = whole.scorer->near_removed(labelled(*maybe.scan, whole.scoring_origin),
                                             std::array<const Labels*, 2>{&labels, &instant});
    };
    const auto use = [&](std::size_t i, MaybeScan&) {
        if (!near[i].empty()) whole.scorer->add_near(std::exchange(near[i], {}));
        return true;  // half of it would be wrong scores; a second interruption kills
    };
    for_each_scan(whole.recording, accepted_scans(whole), find, use);
    whole.summary.scores = whole.scorer->scores(0);
    whole.summary.instant_scores = whole.scorer->scores(1);
}

/// What the filter holds, and how fast its stages were.
void read_contents(Whole& whole) {
    RunSummary& s = whole.summary;
    s.contents = whole.maps.contents();
    const StageTimes times = whole.maps.times();
    for (const Throughput& t : s.contents.throughput) {
        const auto stage = times.find(t.stage);
        const double seconds = stage == times.end() ? 0.0 : stage->second.total();
        s.rates.push_back(
            {t.stage, t.item, seconds > 0.0 ? static_cast<double>(t.count) / seconds : 0.0});
    }
}

Json timing(const Whole& whole) {
    const RunSummary& s = whole.summary;
    Json json = timing_of(s.scans, whole.clock, whole.o.threads);
    for (const RunSummary::Rate& rate : s.rates) {
        json[rate.stage] = {{rate.item + "_per_second", rate.per_second}};
    }
    StageTimes times = whole.maps.times();
    if (whole.worker) times["latency"] = whole.worker->latency();
    json["stages"] = to_json(times);
    json[s.contents.observer] = s.contents.observers;
    json["voxels"] = s.contents.voxels;
    if (whole.worker) {
        const Counters c = whole.worker->counters();
        json["online"] = {{"speed", whole.o.speed},   {"in", c.in},
                          {"processed", c.processed}, {"dropped", c.dropped},
                          {"rejected", c.rejected},   {"queued", c.queued}};
    }
    return json;
}

/// The row of the page that a scan of the recording has.
std::ptrdiff_t row_of(const std::vector<ScanNote>& rows, std::size_t scan) {
    return std::lower_bound(rows.begin(), rows.end(), scan,
                            [](const ScanNote& row, std::size_t i) { return row.index < i; }) -
           rows.begin();
}

/// What the page says of the run in words.
void describe(PageRun& run, const Whole& whole) {
    const RunSummary& s = whole.summary;
    const Config& config = whole.job.config;
    run.info["name"] = whole.output.name().filename().string();
    run.info["command"] = "run";
    run.info["version"] = DYNAMIC_FILTER_VERSION;
    run.info["input"] = whole.recording.info().root.string();
    run.info["format"] = whole.recording.info().layout;
    run.info["created"] = fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)));
    for (const char* name : {"default", "paper"}) {
        if (to_toml(config) == to_toml(preset(name))) run.info["preset"] = name;
    }
    run.info["voxel_size"] = config.map.voxel_size;
    run.info["occupancy_threshold"] = config.map.occupancy_threshold;
    run.info["keyframes_total"] = s.contents.keyframes.empty() ? 0 : s.contents.observers;
    run.info["config"] = to_toml(config);
    run.info["counts"] = {{"static", s.still}, {"dynamic", s.dynamic}, {"unknown", s.unknown}};
    run.info["notes"] = texts_of(s.remarks, RemarkKind::note);
    run.info["alarms"] = Json::array();
    for (const io::Alarm& alarm : s.alarms) {
        run.info["alarms"].push_back({{"text", io::to_text(alarm, whole.recording)},
                                      {"first", row_of(whole.scan_notes, alarm.first)},
                                      {"last", row_of(whole.scan_notes, alarm.last)}});
    }
    run.info["rejected"] = texts_of(s.remarks, RemarkKind::rejected);
    run.info["dropped"] = texts_of(s.remarks, RemarkKind::dropped);
}

/// The page that explains the result.
void write_page(Whole& whole, const Json& metrics) {
    if (!whole.o.report) return;
    if (!whole.shown) {
        whole.summary.remarks.push_back(
            {RemarkKind::note,
             "no report.html: this command was built without the viewer; run script/bootstrap and "
             "script/build"});
        return;
    }
    const Maps& maps = whole.maps;
    whole.objects.finish();
    PageRun run = view_of({.recording = whole.recording,
                           .scans = whole.scan_notes,
                           .sensors = whole.sensors,
                           .shown = whole.shown->take(),
                           .objects = whole.ways.take(kMostObjects),
                           .objects_total = whole.objects.size(),
                           .histories = [&](const auto& voxels) { return maps.histories(voxels); },
                           .keyframes = whole.summary.contents.keyframes,
                           .has_evidence = maps.judges_each_scan()});
    describe(run, whole);
    run.info["scores"] = metrics;
    run.info["timing"] = timing(whole);  // but for the page itself
    const std::string text = embedded(run, 0);
    io::write_file(whole.output.path() / "report.html", page_with({&text, 1}));
    whole.clock.finish("report");
}

void write_reports(Whole& whole) {
    const std::filesystem::path& folder = whole.output.path();
    read_contents(whole);
    const Json metrics = metrics_of(whole.summary);
    write_page(whole, metrics);
    io::write_file(folder / "metrics.json", text_of(metrics));
    whole.summary.seconds = whole.clock.total();
    io::write_file(folder / "run.log",
                   log_of(whole.recording, whole.summary) + to_text(whole.summary));
    io::write_file(folder / "timing.json", text_of(timing(whole)));
}

}  // namespace

RunSummary filter_whole(Job& job, const RunOptions& options, const OutputFolder& output,
                        StageClock& clock, LiveView* live) {
    RunSummary summary;
    with_threads(options.threads, [&] {
        Whole whole{.job = job, .o = options, .output = output, .clock = clock, .live = live};
        whole.summary.remarks = job.remarks;
        if (options.online) whole.worker.emplace(whole.maps, whole.limits(), whole.callbacks());
        io::write_file(output.path() / "config.toml", to_toml(job.config));
        filter_scans(whole);
        clock.finish("filter");
        write_results(whole);
        clock.finish("write");
        whole.summary.interrupted |= interrupted();
        if (whole.scorer && !whole.summary.interrupted) {
            score(whole);
            clock.finish("score");
        }
        write_reports(whole);
        summary = std::move(whole.summary);
    });
    return summary;
}

}  // namespace dynamic_filter::app
