// SPDX-License-Identifier: MIT
#include "run/summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "score/report.hpp"

namespace dynamic_filter::app {

namespace {

using Json = nlohmann::ordered_json;

double per_second(std::size_t items, double seconds) {
    return seconds > 0 ? static_cast<double>(items) / seconds : 0.0;
}

std::size_t peak_rss_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024 * static_cast<std::size_t>(usage.ru_maxrss);
}

std::string shares_of(const RunSummary& s) {
    const auto share = [&](std::size_t n) {
        return s.points == 0 ? 0.0 : 100.0 * static_cast<double>(n) / static_cast<double>(s.points);
    };
    return fmt::format("{:.1f} % static, {:.1f} % dynamic, {:.1f} % unknown", share(s.still),
                       share(s.dynamic), share(s.unknown));
}

}  // namespace

void RunSummary::count(const Labels& labels, const Labels& truth) {
    with_truth += truth.empty() ? 0 : 1;
    ++scans;
    points += labels.size();
    for (const Label label : labels) {
        (label == Label::static_ ? still : label == Label::dynamic ? dynamic : unknown) += 1;
    }
}

void RunSummary::add_alarm(const io::Alarm& alarm, const io::Recording& recording) {
    remarks.push_back({RemarkKind::alarm,
                       fmt::format("{}; {}{}", io::to_text(alarm, recording),
                                   alarm.advice.starts_with("--") ? "try " : "", alarm.advice)});
    alarms.push_back(alarm);
}

void RunSummary::add_watch(const WrittenScans& written, const io::Recording& recording,
                           io::PosesFrom from, const OdometryConfig& config) {
    for (const io::Alarm& alarm : written.breaks) add_alarm(alarm, recording);
    for (io::Alarm& alarm : io::alarms_of(written.watch)) {
        add_alarm(io::explain(std::move(alarm), recording, from, config), recording);
    }
    if (const auto company = io::company_of(written.beside)) {
        remarks.push_back({RemarkKind::note, *company});
    }
}

InputError no_scan_is_usable(const io::Recording& recording, const Remarks& remarks) {
    return {recording.info().root, "",
            "no scan is usable; the first was rejected: " +
                texts_of(remarks, RemarkKind::rejected).front()};
}

Json metrics_of(const RunSummary& s) {
    Json json = Json::object();
    if (s.scores) json = to_json(*s.scores);
    if (s.instant_scores) json["instant"] = to_json(*s.instant_scores);
    if (s.scores) json["voxel_size"] = eval::kVoxelSize;
    if (s.scores && s.with_truth < s.scans) json["scans_with_truth"] = s.with_truth;
    json["scans"] = s.scans;
    json["points"] = {{"static", s.still}, {"dynamic", s.dynamic}, {"unknown", s.unknown}};
    json["rejected"] = texts_of(s.remarks, RemarkKind::rejected);
    json["dropped"] = texts_of(s.remarks, RemarkKind::dropped);
    json["lost"] = texts_of(s.remarks, RemarkKind::lost);
    json["warnings"] = texts_of(s.remarks, RemarkKind::warning);
    json["alarms"] = Json::array();
    for (const io::Alarm& alarm : s.alarms) {
        json["alarms"].push_back({{"what", alarm.what},
                                  {"advice", alarm.advice},
                                  {"first", alarm.first},
                                  {"last", alarm.last},
                                  {"worst", alarm.worst}});
    }
    return json;
}

std::string log_of(const io::Recording& recording, const RunSummary& s) {
    const auto root = std::filesystem::absolute(recording.info().root).lexically_normal();
    std::string log = fmt::format("input    {} ({}, {} scans)\n", root.string(),
                                  recording.info().layout, recording.size());
    log += to_text(s.remarks);
    if (const auto& beams = s.contents.beams) {
        log += fmt::format("beams    {:.2f} deg along azimuth, {:.2f} deg along elevation\n",
                           beams->azimuth_spacing * 180.0 / std::numbers::pi,
                           beams->elevation_spacing * 180.0 / std::numbers::pi);
    }
    if (s.interrupted) log += "interrupted: only the scans filtered so far are here\n";
    return log;
}

Json timing_of(std::size_t scans, const StageClock& clock, int threads) {
    Json stages = Json::array();
    for (const StageClock::Stage& stage : clock.stages()) {
        stages.push_back({{"stage", stage.name},
                          {"wall_seconds", stage.seconds.wall},
                          {"cpu_seconds", stage.seconds.cpu}});
    }
    const Seconds total = clock.total();
    return {{"scans_per_second", per_second(scans, total.wall)},
            {"wall_seconds", total.wall},
            {"cpu_seconds", total.cpu},
            {"process", stages},
            {"peak_rss_bytes", peak_rss_bytes()},
            {"threads", threads > 0 ? threads : available_threads()}};
}

std::string points_text(const RunSummary& s) {
    return fmt::format("{} scans ({} rejected); {} points: {}", s.scans,
                       texts_of(s.remarks, RemarkKind::rejected).size(), s.points, shares_of(s));
}

std::string scores_text(const RunSummary& s) {
    if (!s.scores) return "";
    const std::string of = s.with_truth == s.scans
                               ? "the recording"
                               : fmt::format("{} of {} scans", s.with_truth, s.scans);
    return "scores against the ground truth of " + of + "\n" + table(*s.scores);
}

std::string to_text(const RunSummary& s) {
    std::string text =
        fmt::format("scans    {} ({} rejected), {} {}, {} voxels\n", s.scans,
                    texts_of(s.remarks, RemarkKind::rejected).size(), s.contents.observers,
                    s.contents.observer, s.contents.voxels) +
        fmt::format("points   {}: {}\n", s.points, shares_of(s)) +
        fmt::format("speed    {:.1f} scans/s of the whole run ({:.1f} s, {:.1f} s of CPU)",
                    per_second(s.scans, s.seconds.wall), s.seconds.wall, s.seconds.cpu);
    for (const RunSummary::Rate& rate : s.rates) {
        text += fmt::format("; {} alone {:.1f} {}/s", rate.stage, rate.per_second, rate.item);
    }
    return text + '\n' + scores_text(s);
}

}  // namespace dynamic_filter::app
