// SPDX-License-Identifier: MIT
#include "run/run_reports.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include "dynamic_filter/file.hpp"
#include "dynamic_filter/parallel.hpp"
#include "page/page.hpp"
#include "score/report.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

double total(const StageTimes& times, const std::string& stage) {
    const auto it = times.find(stage);
    return it == times.end() ? 0.0 : it->second.total();
}

double per_second(std::size_t items, double seconds) {
    return seconds > 0 ? static_cast<double>(items) / seconds : 0.0;
}

nlohmann::ordered_json timing(const Pass& pass) {
    const RunSummary& s = pass.summary;
    const Seconds total = pass.clock.total();
    const int threads = pass.pace.threads;
    nlohmann::ordered_json json{{"scans_per_second", per_second(s.scans, total.wall)},
                                {"wall_seconds", total.wall},
                                {"cpu_seconds", total.cpu},
                                {"process", by_stage(pass.clock)}};
    for (const RunSummary::Rate& rate : s.rates) {
        json[rate.stage] = {{rate.item + "_per_second", rate.per_second}};
    }
    json["stages"] = to_json(pass.filter.times());
    json[s.contents.observer] = s.contents.observers;
    json["voxels"] = s.contents.voxels;
    json["peak_rss_bytes"] = peak_rss_bytes();
    json["threads"] = threads > 0 ? threads : available_threads();
    if (pass.pace.online) {
        const Counters c = pass.filter.counters();
        json["online"] = {{"speed", *pass.pace.online}, {"in", c.in},
                          {"processed", c.processed},   {"dropped", c.dropped},
                          {"rejected", c.rejected},     {"queued", c.queued}};
    }
    return json;
}

void write_log(const Pass& pass) {
    std::string log =
        fmt::format("input    {} ({}, {} scans)\n", pass.sequence.info().root.string(),
                    pass.sequence.info().layout, pass.sequence.size());
    for (const std::string& note : pass.sequence.info().notes) log += "note     " + note + "\n";
    for (const std::string& note : pass.summary.notes) log += "note     " + note + "\n";
    for (const std::string& line : pass.sequence.info().losses) log += "lost     " + line + "\n";
    for (const std::string& line : pass.summary.rejected) log += "rejected " + line + "\n";
    for (const std::string& line : pass.summary.dropped) log += "dropped  " + line + "\n";
    if (const auto beams = pass.summary.contents.beams) {
        log += fmt::format("beams    {:.2f} deg along azimuth, {:.2f} deg along elevation\n",
                           beams->azimuth_spacing * 180.0 / M_PI,
                           beams->elevation_spacing * 180.0 / M_PI);
    }
    if (pass.summary.interrupted) log += "interrupted: only the scans filtered so far are here\n";
    io::write_file(pass.output.path() / "run.log", log + to_text(pass.summary));
}

void describe(PageRun& run, const Pass& pass) {
    run.info["name"] = pass.output.name().filename().string();
    run.info["command"] = "run";
    run.info["version"] = DYNAMIC_FILTER_VERSION;
    run.info["input"] = pass.sequence.info().root.string();
    run.info["format"] = pass.sequence.info().layout;
    run.info["created"] = fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)));
    for (const char* name : {"default", "paper"}) {
        if (to_toml(pass.config) == to_toml(preset(name))) run.info["preset"] = name;
    }
    run.info["voxel_size"] = pass.config.map.voxel_size;
    run.info["occupancy_threshold"] = pass.config.map.occupancy_threshold;
    const MapContents& contents = pass.summary.contents;
    run.info["keyframes_total"] = contents.keyframes.empty() ? 0 : contents.observers;
    run.info["config"] = to_toml(pass.config);
    const RunSummary& s = pass.summary;
    run.info["counts"] = {{"static", s.still}, {"dynamic", s.dynamic}, {"unknown", s.unknown}};
    run.info["notes"] = pass.sequence.info().notes;
    for (const std::string& note : s.notes) run.info["notes"].push_back(note);
    run.info["rejected"] = s.rejected;
    run.info["dropped"] = s.dropped;
}

/// The page that explains the result.
void write_report(Pass& pass, const nlohmann::ordered_json& metrics) {
    if (!pass.extras.report) return;
    if (viewer_page().empty()) {
        pass.summary.notes.emplace_back(
            "no report.html: this command was built without the viewer; run script/bootstrap and "
            "script/build");
        return;
    }
    PageRun run = view_of({pass.sequence, pass.filter, pass.scan_notes, pass.instant,
                           pass.output.path() / "labels", pass.filter.judges_each_scan()});
    describe(run, pass);
    run.info["scores"] = metrics;
    run.info["timing"] = timing(pass);  // but for the page itself
    const std::string text = embedded(run, 0);
    io::write_file(pass.output.path() / "report.html", page_with({&text, 1}));
    pass.clock.finish("report");
}

/// What the filter holds, and how fast its stages were.
void take_contents(Pass& pass) {
    RunSummary& s = pass.summary;
    s.contents = pass.filter.contents();
    const StageTimes times = pass.filter.times();
    for (const Throughput& t : s.contents.throughput) {
        s.rates.push_back({t.stage, t.item, per_second(t.count, total(times, t.stage))});
    }
}

}  // namespace

nlohmann::ordered_json by_stage(const StageClock& clock) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const StageClock::Stage& stage : clock.stages()) {
        json.push_back({{"stage", stage.name},
                        {"wall_seconds", stage.seconds.wall},
                        {"cpu_seconds", stage.seconds.cpu}});
    }
    return json;
}

std::size_t peak_rss_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024 * static_cast<std::size_t>(usage.ru_maxrss);
}

nlohmann::ordered_json metrics_of(const RunSummary& s, const std::vector<std::string>& losses) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    if (s.scores) json = to_json(*s.scores);
    if (s.instant_scores) json["instant"] = to_json(*s.instant_scores);
    if (s.scores) json["voxel_size"] = eval::kVoxelSize;
    json["scans"] = s.scans;
    json["points"] = {{"static", s.still}, {"dynamic", s.dynamic}, {"unknown", s.unknown}};
    json["rejected"] = s.rejected;
    json["dropped"] = s.dropped;
    json["lost"] = losses;
    return json;
}

void write_reports(Pass& pass) {
    take_contents(pass);
    const nlohmann::ordered_json metrics = metrics_of(pass.summary, pass.sequence.info().losses);
    write_report(pass, metrics);
    io::write_file(pass.output.path() / "metrics.json", text_of(metrics));
    pass.summary.seconds = pass.clock.total();
    write_log(pass);
    io::write_file(pass.output.path() / "timing.json", text_of(timing(pass)));
}

std::string shares_of(const RunSummary& s) {
    const auto share = [&](std::size_t n) {
        return s.points == 0 ? 0.0 : 100.0 * static_cast<double>(n) / static_cast<double>(s.points);
    };
    return fmt::format("{:.1f} % static, {:.1f} % dynamic, {:.1f} % unknown", share(s.still),
                       share(s.dynamic), share(s.unknown));
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
    text += '\n';
    if (s.scores) text += "scores against the ground truth of the recording\n" + table(*s.scores);
    return text;
}

}  // namespace dynamic_filter::app
