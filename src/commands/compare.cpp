// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/voxel_map/map_index.hpp"
#include "page/run_view.hpp"
#include "recording/frames.hpp"
#include "run/commands.hpp"
#include "score/report.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

std::string name_of(const fs::path& result) {
    return fs::absolute(result / "").lexically_normal().parent_path().filename().string();
}

/// A map that somebody else made clean: its points, and its scores if there is ground truth.
PageRun view_of_map(const fs::path& file, const io::Sequence* truth, double voxel) {
    const io::Cloud cloud = io::read_cloud(file);
    PageRun run = view_of(cloud);
    run.info["name"] = file.filename().string();
    run.info["command"] = "";
    run.info["version"] = DYNAMIC_FILTER_VERSION;
    run.info["input"] = file.string();
    run.info["scores"] = nullptr;
    if (truth == nullptr) return run;
    const Eigen::Vector3d origin = scoring_origin(*truth, voxel);
    run.info["scores"] = to_json(eval::score_map(truth->size(), scan_source(*truth, origin, {}),
                                                 positions_from(cloud, origin), voxel));
    return run;
}

std::string run_of(const fs::path& result, std::size_t number, const io::Sequence* truth,
                   double voxel) {
    if (fs::is_directory(result)) {
        const fs::path page = result / "report.html";
        if (is_city_map(result)) {
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
    return embedded(view_of_map(result, truth, voxel), number);
}

}  // namespace

int report(const ReportOptions& o) {
    require_extension(o.output, ".html");
    std::optional<io::Sequence> truth;
    if (!o.truth.data.empty()) truth = open(o.truth);
    if (truth && !truth->has_truth()) {
        throw InputError(o.truth.data, "",
                         "has no ground truth (labels/*.label, or 0/1 intensities)");
    }
    std::vector<std::string> runs;
    for (const fs::path& result : o.results) {
        if (fs::exists(o.output) && fs::equivalent(result, o.output)) {
            throw ConfigError(o.output.string() + ": is what is to be shown; choose another -o");
        }
        runs.push_back(run_of(result, runs.size(), truth ? &*truth : nullptr, o.voxel));
        fmt::print("{:<10} {}\n", runs.size() == 1 ? "shown" : "beside it", name_of(result));
    }
    io::write_file(o.output, page_with(runs));
    fmt::print("written    {}\n", o.output.string());
    return kDone;
}

}  // namespace dynamic_filter::app
