// SPDX-License-Identifier: MIT
#include "run/summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>
#include <numbers>

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

std::vector<std::string> alarm_lines(const io::Recording& recording, const RunSummary& s) {
    std::vector<std::string> lines;
    for (const io::Alarm& alarm : s.alarms) {
        lines.push_back(fmt::format("{}; {}{}", io::to_text(alarm, recording),
                                    alarm.advice.starts_with("--") ? "try " : "", alarm.advice));
    }
    return lines;
}

}  // namespace

void RunSummary::count(const Labels& labels) {
    ++scans;
    points += labels.size();
    for (const Label label : labels) {
        (label == Label::static_ ? still : label == Label::dynamic ? dynamic : unknown) += 1;
    }
}

InputError no_scan_is_usable(const io::Recording& recording,
                             const std::vector<std::string>& rejected) {
    return {recording.info().root, "",
            "no scan is usable; the first was rejected: " + rejected.front()};
}

Json metrics_of(const RunSummary& s, const std::vector<std::string>& losses) {
    Json json = Json::object();
    if (s.scores) json = to_json(*s.scores);
    if (s.instant_scores) json["instant"] = to_json(*s.instant_scores);
    if (s.scores) json["voxel_size"] = eval::kVoxelSize;
    json["scans"] = s.scans;
    json["points"] = {{"static", s.still}, {"dynamic", s.dynamic}, {"unknown", s.unknown}};
    json["rejected"] = s.rejected;
    json["dropped"] = s.dropped;
    json["lost"] = losses;
    json["warnings"] = s.warnings;
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
    const auto add = [&](const char* what, const std::vector<std::string>& lines) {
        for (const std::string& line : lines) log += fmt::format("{:<8} {}\n", what, line);
    };
    add("note", s.notes);
    add("warning", s.warnings);
    add("lost", recording.info().losses);
    add("rejected", s.rejected);
    add("dropped", s.dropped);
    add("alarm", alarm_lines(recording, s));
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
    return fmt::format("{} scans ({} rejected); {} points: {}", s.scans, s.rejected.size(),
                       s.points, shares_of(s));
}

std::string scores_text(const RunSummary& s) {
    if (!s.scores) return "";
    return "scores against the ground truth of the recording\n" + table(*s.scores);
}

std::string to_text(const RunSummary& s) {
    std::string text =
        fmt::format("scans    {} ({} rejected), {} {}, {} voxels\n", s.scans, s.rejected.size(),
                    s.contents.observers, s.contents.observer, s.contents.voxels) +
        fmt::format("points   {}: {}\n", s.points, shares_of(s)) +
        fmt::format("speed    {:.1f} scans/s of the whole run ({:.1f} s, {:.1f} s of CPU)",
                    per_second(s.scans, s.seconds.wall), s.seconds.wall, s.seconds.cpu);
    for (const RunSummary::Rate& rate : s.rates) {
        text += fmt::format("; {} alone {:.1f} {}/s", rate.stage, rate.per_second, rate.item);
    }
    return text + '\n' + scores_text(s);
}

bool tell_losses(const std::string& name, const io::Recording& recording, const RunSummary& s) {
    const auto tell = [&](const char* what, const std::vector<std::string>& lines) {
        for (const std::string& line : lines) {
            fmt::print(stderr, "{:<8} {}{}\n", what, name, line);
        }
        return lines.empty();
    };
    const bool all_read = tell("lost", recording.info().losses),
               none_rejected = tell("rejected", s.rejected),
               none_dropped = tell("dropped", s.dropped);
    return tell("alarm", alarm_lines(recording, s)) && all_read && none_rejected && none_dropped;
}

}  // namespace dynamic_filter::app
