// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/exit_code.hpp"
#include "base/say.hpp"
#include "commands/all.hpp"
#include "commands/shared_options.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/voxel_map/map_index.hpp"
#include "page/run_view.hpp"
#include "recording/data_options.hpp"
#include "recording/folders.hpp"
#include "recording/scans.hpp"
#include "run/open_for_result.hpp"
#include "run/scored_scans.hpp"
#include "score/report.hpp"

namespace dynamic_filter::app {

namespace {

struct ReportOptions {
    std::vector<std::filesystem::path> results;  ///< folders of runs, their reports, clouds
    std::filesystem::path output = "report.html";
    DataOptions truth;
    double voxel = eval::kVoxelSize;
};

namespace fs = std::filesystem;

std::string name_of(const fs::path& result) { return io::whole_path(result).filename().string(); }

/// A map that somebody else made clean: its points, and its scores if there is ground truth.
PageRun view_of_map(const fs::path& file, const ReportOptions& o) {
    const io::Cloud cloud = io::read_cloud(file);
    PageRun run = view_of(cloud);
    run.info["name"] = file.filename().string();
    run.info["command"] = "";
    run.info["version"] = DYNAMIC_FILTER_VERSION;
    run.info["input"] = file.string();
    run.info["scores"] = nullptr;
    if (o.truth.data.empty()) return run;
    const RecordingOfResult opened = open_for_result(o.truth, file);
    if (!opened.note.empty()) say(stderr, "note: {}\n", opened.note);
    const io::Recording& truth = opened.recording;
    const Eigen::Vector3d origin = scoring_origin(truth, o.voxel);
    run.info["scores"] = to_json(eval::score_map(truth.size(), scan_source(truth, origin, {}),
                                                 positions_from(cloud, origin), o.voxel));
    return run;
}

std::string run_of(const fs::path& result, std::size_t number, const ReportOptions& o) {
    if (fs::is_directory(result)) {
        const fs::path page = result / "report.html";
        if (is_tiled_map(result)) {
            throw ConfigError(result.string() +
                              ": is the map of several drives, whose report has pages of its own; "
                              "open " +
                              page.string());
        }
        if (!fs::exists(page)) {
            throw InputError(result, "",
                             "holds no report.html; expected the output folder of a run (without "
                             "one, run again with --overwrite and without --no-report)");
        }
        return run_of_report(page, number);
    }
    if (result.extension() == ".html") return run_of_report(result, number);
    return embedded(view_of_map(result, o), number);
}

}  // namespace

int report(const ReportOptions& o) {
    require_extension(o.output, ".html");
    if (!o.truth.data.empty() && !open(o.truth).info().has_truth()) {
        throw InputError(o.truth.data, "",
                         "has no ground truth (labels/*.label, or 0/1 intensities)");
    }
    std::vector<std::string> runs;
    for (const fs::path& result : o.results) {
        if (fs::exists(o.output) && fs::equivalent(result, o.output)) {
            throw ConfigError(o.output.string() + ": is what is to be shown; choose another -o");
        }
        runs.push_back(run_of(result, runs.size(), o));
        say("{:<10} {}\n", runs.size() == 1 ? "shown" : "beside it", name_of(result));
    }
    io::write_file(o.output, page_with(runs));
    say("written    {}\n", o.output.string());
    return kDone;
}

void add_report(Program& program) {
    Command c = program.command("report", "Show runs and maps side by side on one page");
    const auto o = std::make_shared<ReportOptions>();
    c.paths("RESULT", o->results,
            "output folders of runs, or clean maps of other programs (.pcd, .ply, ...) in the "
            "world frame; at most four",
            4)
        .required();
    c.path("-o,--output", o->output, "file of the page");
    c.path("--truth", o->truth.data, "recording with ground truth, by which maps are scored");
    add_reading_options(c, o->truth);
    add_selection_options(c, o->truth);
    c.number("--voxel", o->voxel, {0.01, 10.0}, "edge of a voxel for the scores [m]");
    c.action([o] {
        if (o->truth.data.empty() && (o->truth.first > 0 || o->truth.last || o->truth.stride > 1)) {
            throw ConfigError(
                "--first, --last and --stride choose scans of --truth, which is not given");
        }
        return report(*o);
    });
}

}  // namespace dynamic_filter::app
