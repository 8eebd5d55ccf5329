// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <csignal>

#include "base/edit_distance.hpp"
#include "commands/failure.hpp"
#include "commands/freed_memory.hpp"
#include "dynamic_filter/error.hpp"
#include "live/live_command.hpp"
#include "live/live_options.hpp"
#include "run/commands.hpp"
#include "score/protocols.hpp"

namespace {

using namespace dynamic_filter;
using namespace dynamic_filter::app;

/// CLI11's own name the bounds with all 309 digits of the greatest double.
CLI::Validator whole_from(std::size_t least) {
    const auto check = [least](const std::string& text) -> std::string {
        std::size_t value = 0;
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        if (error == std::errc{} && stop == end && value >= least) return "";
        return fmt::format("'{}' is no whole number of {} or more", text, least);
    };
    return CLI::Validator(check, fmt::format("whole, {} or more", least));
}

/// How `--help` shows a choice; the completion of shells reads it there.
std::string one_of(const std::vector<std::string>& choices) {
    return fmt::format("{{{}}}", fmt::join(choices, ","));
}

void add_config_options(CLI::App& command, ConfigOptions& o) {
    command.add_option("--preset", o.preset, "which settings to begin with")
        ->type_name(one_of({"default", "paper"}))
        ->capture_default_str();
    command.add_option("--config", o.file,
                       "TOML file with settings, as `dynamicfilter config` prints them");
    command
        .add_option("--set", o.assignments, "change one setting, for instance map.voxel_size=0.1")
        ->take_all()
        ->expected(1);
}

void add_reading_options(CLI::App& command, DataOptions& o) {
    command.add_option(
        "--poses", o.open.poses,
        "pose file; `none` finds the poses by odometry (default: the recording's own poses)");
    command
        .add_option("--format", o.format,
                    "format of the recording (default: recognised by its files)")
        ->type_name(one_of({"kitti", "benchmark", "folder", "bag"}));
    command.add_option("--topic", o.open.topic,
                       "topic of the scans in a bag (default: the only one)");
    command.add_option("--pose-topic", o.open.pose_topic,
                       "topic of the poses in a bag, or /tf (default: the one that fits)");
    std::vector<std::string> fixes{"none"};
    for (const io::PoseFix fix : io::pose_fixes()) fixes.push_back(io::to_string(fix));
    command
        .add_option("--pose-fix", o.pose_fix,
                    fmt::format("correct the poses: {}; `check` says which one is needed",
                                fmt::join(fixes, ", ")))
        ->check(CLI::IsMember(fixes));
    command.add_flag("--points-in-world", o.open.points_in_world,
                     "the points are in the world frame, not in the sensor's frame");
    command.add_option("--time-unit", o.time_unit, "unit of the stamps")
        ->check(CLI::IsMember({"s", "ms", "us", "ns"}))
        ->capture_default_str();
    command
        .add_option("--deskew", o.deskew,
                    "undo the sensor's motion during each scan; auto does so if the scans overlay "
                    "better then")
        ->check(CLI::IsMember({"auto", "on", "off"}))
        ->expected(0, 1)
        ->default_str("auto");
}

void add_selection_options(CLI::App& command, DataOptions& o) {
    command.add_option("--first", o.open.first, "index of the first scan to use")
        ->check(whole_from(0));
    command.add_option("--last", o.open.last, "index of the last scan to use")
        ->check(whole_from(0));
    command.add_option("--stride", o.open.stride, "use every n-th scan only")->check(whole_from(1));
}

/// One recording or several; a list of them counts as several.
void add_recordings(CLI::App& command, RunOptions& o) {
    command
        .add_option("DATA", o.city.recordings,
                    "a bag (.mcap, .bag, .db3), or a folder with scans and poses; several drives "
                    "through one world, or a .txt file that lists them, give one map")
        ->required()
        ->type_name("PATH");
}

void add_tile_voxels(CLI::App& command, RunOptions& o) {
    command
        .add_option("--tile-voxels", o.city.tile_voxels,
                    "most voxels in a tile; fewer need less memory, and more time")
        ->check(whole_from(kFewestTileVoxels))
        ->capture_default_str();
}

void add_run(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<RunOptions>();
    CLI::App& c = *app.add_subcommand("run", "Remove moving objects from a recording");
    add_recordings(c, *o);
    c.add_option("-o,--output", o->output, "output folder (default: results/<UTC stamp>)");
    add_reading_options(c, o->data);
    add_config_options(c, o->config);
    add_selection_options(c, o->data);
    CLI::Option* const part =
        c.add_option("--part", o->city.part,
                     "I/N: filter only the tiles of part I of N; `dynamicfilter merge` puts the "
                     "parts together");
    c.add_flag("--mpi", o->city.mpi, "share the tiles out among the processes that mpirun started")
        ->excludes(part);
    c.add_option("--memory", o->city.memory,
                 "most memory to use, for instance 1.5G: filter tile by tile");
    c.add_option("--plan", o->city.plan,
                 "file that `dynamicfilter plan -o` wrote, so that the scans need not be read to "
                 "plan the tiles");
    add_tile_voxels(c, *o);
    c.add_option(
         "--refine", o->refine,
         "refine the given poses by registering the scans; auto does so if the scans overlay "
         "better then")
        ->check(CLI::IsMember({"auto", "on", "off"}))
        ->capture_default_str();
    c.add_option("--threads", o->threads, "number of threads; 0 uses all cores")
        ->check(CLI::Range(0, 1024));
    CLI::Option* const online = c.add_flag(
        "--online", o->online,
        "replay the recording as a sensor would send it; scans are dropped if the filter is too "
        "slow for them");
    c.add_option(
         "--speed", o->speed,
         "with --online: how many times as fast as the sensor; 0 is as fast as possible, and drops "
         "nothing")
        ->needs(online)
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    CLI::Option* const overwrite = c.add_flag(
        "--overwrite", o->overwrite,
        "replace the result of an earlier run in the output folder, once this run is complete");
    c.add_flag("--resume", o->resume,
               "continue a run that was interrupted or killed; the result is that of an "
               "uninterrupted run")
        ->excludes(overwrite);
    CLI::Option* const view = c.add_flag(
        "--view", o->view, "show the run live in a browser, at the address that it prints");
    c.add_option("--port", o->port, "port of the view (default: any free one)")->needs(view);
    c.add_option("--edits", o->edits,
                 "edits.json of another run, which is applied to labels and maps (default: that of "
                 "the output folder)");
    c.add_flag("!--no-maps", o->maps, "do not write static_map.pcd and dynamic_points.pcd");
    c.add_flag("!--no-report", o->report, "do not write report.html")->excludes(view);
    c.add_flag("-q,--quiet", o->quiet, "print only warnings and errors");
    c.callback([o, &chosen] {
        o->data.data = o->city.recordings.front();
        chosen = [o] { return run(*o); };
    });
}

void add_plan(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<PlanOptions>();
    CLI::App& c = *app.add_subcommand(
        "plan", "Show the tiles, the time and the memory that a run over large recordings takes");
    add_recordings(c, o->run);
    c.add_option("-o,--output", o->run.output, "also write the plan to this file, for run --plan");
    add_reading_options(c, o->run.data);
    add_config_options(c, o->run.config);
    add_selection_options(c, o->run.data);
    add_tile_voxels(c, o->run);
    c.add_option("--parts", o->parts, "number of parts into which the tiles are divided")
        ->check(CLI::Range(std::size_t{1}, std::size_t{100000}))
        ->capture_default_str();
    c.add_flag("--json", o->json, "print every tile, as JSON");
    c.add_option("--threads", o->run.threads, "number of threads; 0 uses all cores")
        ->check(CLI::Range(0, 1024));
    c.add_flag("--overwrite", o->run.overwrite, "replace the file of -o");
    c.add_flag("-q,--quiet", o->run.quiet, "print only the plan, warnings and errors");
    c.callback([o, &chosen] { chosen = [o] { return plan(*o); }; });
}

void add_merge(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<MergeOptions>();
    CLI::App& c = *app.add_subcommand("merge", "Put the parts of a run together (see run --part)");
    c.add_option("PART", o->parts, "output folders of all parts")->required()->type_name("PATH");
    c.add_option("-o,--output", o->output, "output folder")->required();
    c.add_option("--threads", o->threads, "number of threads; 0 uses all cores")
        ->check(CLI::Range(0, 1024));
    c.add_flag("--overwrite", o->overwrite, "replace an earlier result in the output folder");
    c.add_flag("-q,--quiet", o->quiet, "print only warnings and errors");
    c.callback([o, &chosen] { chosen = [o] { return merge(*o); }; });
}

void add_live(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<live::LiveOptions>();
    CLI::App& c = *app.add_subcommand(
        "live", "Filter what a robot's LiDAR publishes by ROS 2, and publish the result");
    live::add_live_options(c, *o);
    c.callback([o, &chosen] { chosen = [o] { return live::live_on_dds(*o); }; });
}

void add_eval(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<EvalOptions>();
    CLI::App& c = *app.add_subcommand("eval", "Score labels or a map against ground truth");
    c.add_option("--truth", o->truth.data, "recording with ground truth")->required();
    CLI::Option_group& result = *c.add_option_group("result");
    result.add_option("--labels", o->labels,
                      "folder with label files, or the output folder of a run");
    result.add_option("--map", o->map, "clean map (.pcd or .ply) in the world frame");
    result.require_option(1);
    add_reading_options(c, o->truth);
    c.add_option("--voxel", o->voxel, "edge of a voxel [m]")
        ->check(CLI::Range(0.01, 10.0))
        ->capture_default_str();
    c.add_option("--protocol", o->protocol,
                 "rules by which to score: voxel is this project's, strict FreeDOM's, benchmark "
                 "DynamicMap_Benchmark's, mos SemanticKITTI-MOS'")
        ->check(CLI::IsMember(protocol_names()))
        ->capture_default_str();
    c.add_option("--min-range", o->ranges.min,
                 "leave out points nearer to the sensor than this [m]")
        ->check(CLI::Range(0.0, 1e6));
    c.add_option("--max-range", o->ranges.max, "leave out points farther from the sensor [m]")
        ->check(CLI::Range(0.0, 1e6));
    c.add_option("--json", o->json, "also write all scores to this file");
    c.callback([o, &chosen] { chosen = [o] { return evaluate(*o); }; });
}

void add_simulate(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<SimulateOptions>();
    auto& s = o->simulation;
    CLI::App& c = *app.add_subcommand("simulate", "Simulate a recording with exact labels");
    c.add_option("SCENE", s.scene, "what to simulate")
        ->type_name(one_of(sim::scene_names()))
        ->required();
    c.add_option("-o,--output", o->output, "output folder")->required();
    c.add_option("--pedestrians", s.pedestrians,
                 "number of pedestrians (default: the scene's own number)");
    c.add_option("--seed", s.seed, "seed of the random numbers; the same seed gives the same bytes")
        ->check(whole_from(0))
        ->capture_default_str();
    c.add_option("--sensor", s.sensor, "LiDAR to simulate")
        ->type_name(one_of(sim::sensor_names()))
        ->capture_default_str();
    c.add_option("--frames", s.frames, "number of scans (default: the whole scene)")
        ->check(whole_from(1));
    c.add_option("--rate", s.rate_hz, "scans per second (default: the scene's own)")
        ->check(CLI::Range(0.0, 100.0));
    c.add_option("--rounds", s.rounds,
                 "rounds that the robot drives in the scene crowd (default: 2)")
        ->check(CLI::Range(1, 100));
    c.add_option("--km", s.km,
                 "length of each drive [km], in the scene city: up to 80 (default: 1)")
        ->check(CLI::Range(0.01, 80.0));
    c.add_option(
         "--drives", s.drives,
         "drives on different days, in the scene city (default: 3); they become OUTPUT/drive_1 "
         "and so on")
        ->check(CLI::Range(1, 1000));
    c.add_flag("--sweep", s.sweep,
               "measure the points of a scan one after the other while everything moves, as a real "
               "sensor does; the scans are then PCD files with the time of each point");
    c.add_option("--pose-noise", s.pose_noise_m, "standard deviation of each axis [m]")
        ->check(CLI::Range(0.0, 10.0));
    c.add_option("--pose-noise-deg", s.pose_noise_deg, "standard deviation of each axis [deg]")
        ->check(CLI::Range(0.0, 90.0));
    c.add_flag("--overwrite", o->overwrite, "replace an earlier recording in the output folder");
    c.add_flag("-q,--quiet", o->quiet, "print only warnings and errors");
    c.callback([o, &chosen] { chosen = [o] { return simulate(*o); }; });
}

void add_convert(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<ConvertOptions>();
    CLI::App& c = *app.add_subcommand("convert", "Write a recording or a cloud in another format");
    c.add_option("IN", o->data.data, "recording or cloud file")->required();
    c.add_option(
         "OUT", o->output,
         "bag (.mcap, .bag, .db3), folder, or cloud file (.pcd, .ply, .las, .npy, .bin): of "
         "a recording, all its points in the world's frame")
        ->required();
    c.add_option(
         "--to", o->to,
         "layout of the output folder: kitti (default), benchmark, or autoware (map tiles); "
         "of the map of several drives: 3dtiles, las or autoware")
        ->check(CLI::IsMember({"kitti", "benchmark", "autoware", "3dtiles", "las"}));
    c.add_option("--origin", o->origin,
                 "with --to 3dtiles: LAT,LON[,HEIGHT] of the world's origin, whose x points to the "
                 "east (default: the tiles stay in the world frame)");
    c.add_option(
        "--labels", o->labels,
        "output folder of a run, or its labels (default: the ground truth of the recording)");
    add_reading_options(c, o->data);
    add_selection_options(c, o->data);
    c.add_flag("--overwrite", o->overwrite, "replace an existing output");
    c.callback([o, &chosen] { chosen = [o] { return convert(*o); }; });
}

void add_report(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<ReportOptions>();
    CLI::App& c = *app.add_subcommand("report", "Show runs and maps side by side on one page");
    c.add_option(
         "RESULT", o->results,
         "output folders of runs, or clean maps of other programs (.pcd, .ply, ...) in the world "
         "frame; at most four")
        ->required()
        ->expected(1, 4);
    c.add_option("-o,--output", o->output, "file of the page")->capture_default_str();
    c.add_option("--truth", o->truth.data, "recording with ground truth, by which maps are scored");
    add_reading_options(c, o->truth);
    c.add_option("--voxel", o->voxel, "edge of a voxel for the scores [m]")
        ->check(CLI::Range(0.01, 10.0))
        ->capture_default_str();
    c.callback([o, &chosen] { chosen = [o] { return report(*o); }; });

    auto s = std::make_shared<ServeOptions>();
    CLI::App& serve_command =
        *app.add_subcommand("serve", "Show reports in a browser, on this machine");
    serve_command
        .add_option("DIR", s->folder, "output folder of a run, or a folder that holds several")
        ->required();
    serve_command.add_option("--port", s->port, "port (default: any free one)");
    serve_command.add_flag(
        "--edit", s->edit,
        "correct the labels of this run by hand in the page; the corrections are "
        "kept in DIR/edits.json");
    serve_command.callback([s, &chosen] { chosen = [s] { return serve(*s); }; });
}

void add_render(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<RenderOptions>();
    CLI::App& c =
        *app.add_subcommand("render", "Draw a map, or animate how a recording is cleaned");
    c.add_option("IN", o->data.data,
                 "output folder of a run, cloud file, or a recording to animate")
        ->required();
    c.add_option("-o,--output", o->output,
                 "picture to write: .png of a run or cloud, .webp of a recording")
        ->required();
    CLI::Option* const above = c.add_flag("--top", o->from_above, "look straight down");
    c.add_flag("--clean", o->clean, "leave out the removed points");
    c.add_option("--width", o->width, "[pixels]")
        ->check(CLI::Range(16, 16384))
        ->capture_default_str();
    c.add_option("--height", o->height, "[pixels]")
        ->check(CLI::Range(16, 16384))
        ->capture_default_str();
    c.add_option("--azimuth", o->azimuth_deg,
                 "where the camera stands, as an angle from the x axis [deg]")
        ->excludes(above)
        ->capture_default_str();
    c.add_option("--elevation", o->elevation_deg,
                 "how far the camera looks down from the horizon [deg]")
        ->excludes(above)
        ->check(CLI::Range(1.0, 89.0))
        ->capture_default_str();
    c.add_option("--point-size", o->point_size, "size of a point [pixels]")
        ->check(CLI::Range(0.5, 50.0))
        ->capture_default_str();
    c.add_option("--pictures", o->pictures, "number of pictures of an animation")
        ->check(CLI::Range(2, 1000))
        ->capture_default_str();
    add_reading_options(c, o->data);
    add_selection_options(c, o->data);
    add_config_options(c, o->config);
    c.callback([o, &chosen] { chosen = [o] { return render(*o); }; });
}

void add_others(CLI::App& app, std::function<int()>& chosen) {
    auto demo_options = std::make_shared<DemoOptions>();
    CLI::App& d = *app.add_subcommand(
        "demo", "Simulate a crowd, remove it, score and draw the result; needs no data");
    d.add_option("-o,--output", demo_options->output, "output folder")->capture_default_str();
    d.callback([=, &chosen] { chosen = [=] { return demo(*demo_options); }; });

    auto checked = std::make_shared<CheckOptions>();
    CLI::App& check_command =
        *app.add_subcommand("check", "Look for mistakes in poses, frames and stamps of recordings");
    check_command
        .add_option(
            "DATA", checked->recordings,
            "recording; or several in one world frame, or a list of them (.txt), which are then "
            "compared")
        ->required();
    add_reading_options(check_command, checked->how);
    add_selection_options(check_command, checked->how);
    check_command.callback([=, &chosen] { chosen = [=] { return check(*checked); }; });

    auto track = std::make_shared<OdometryOptions>();
    CLI::App& o = *app.add_subcommand("odometry", "Find the poses of a recording from its scans");
    o.add_option("DATA", track->data.data, "recording")->required();
    o.add_option("-o,--output", track->output,
                 "pose file: .tum with stamps, otherwise KITTI's rows")
        ->required();
    add_reading_options(o, track->data);
    add_selection_options(o, track->data);
    add_config_options(o, track->config);
    o.add_flag("--overwrite", track->overwrite, "replace an existing file");
    o.add_flag("-q,--quiet", track->quiet, "print only warnings and errors");
    o.callback([=, &chosen] { chosen = [=] { return odometry(*track); }; });

    auto file = std::make_shared<std::filesystem::path>();
    CLI::App& i = *app.add_subcommand(
        "info", "Describe a point cloud file, a recording, or the map of several drives");
    i.add_option("FILE", *file, "point cloud file, bag or folder")->required();
    i.callback([=, &chosen] { chosen = [=] { return info(*file); }; });

    auto config_options = std::make_shared<ConfigOptions>();
    CLI::App& c = *app.add_subcommand("config", "Print all settings as TOML or JSON");
    add_config_options(c, *config_options);
    auto json = std::make_shared<bool>(false);
    c.add_flag("--json", *json, "print JSON, with the bounds of each setting");
    c.callback([=, &chosen] { chosen = [=] { return show_config(*config_options, *json); }; });
}

std::string did_you_mean(const std::string& given, const std::vector<std::string>& known) {
    const std::string nearest = nearest_word(given, known);
    return nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest);
}

/// CLI11 would only ask for a subcommand.
void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
    const std::string given = argc > 1 ? argv[1] : "-";
    std::vector<std::string> known;
    for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
    if (given.starts_with('-') || std::find(known.begin(), known.end(), given) != known.end()) {
        return;
    }
    throw ConfigError(fmt::format("unknown command '{}'{}; the commands are: {}", given,
                                  did_you_mean(given, known), fmt::join(known, ", ")));
}

/// CLI11 names what it did not expect, but not what may have been meant.
[[noreturn]] void refuse_unknown_options(const CLI::App& app) {
    const auto given_commands = app.get_subcommands();
    const bool has_command = !given_commands.empty();
    const CLI::App& command = has_command ? *given_commands.front() : app;
    std::vector<std::string> known;
    const auto add = [&known](const CLI::App& group) {
        for (const CLI::Option* option : group.get_options()) {
            for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
        }
    };
    add(command);
    for (const CLI::App* group : command.get_subcommands({})) {
        if (has_command) add(*group);
    }
    std::string text;
    for (const std::string& given : app.remaining(true)) {
        const bool is_option = given.starts_with('-');
        if (!text.empty() && !is_option) continue;  // the value of an unknown option
        const std::string name = given.substr(0, given.find('='));
        text += fmt::format("{}unknown {} '{}'{}", text.empty() ? "" : "; ",
                            is_option ? "option" : "argument", name,
                            is_option ? did_you_mean(name, known) : "");
    }
    if (!has_command) {
        throw ConfigError(text +
                          "; options come after a command, and `dynamicfilter --help` lists "
                          "the commands");
    }
    throw ConfigError(
        fmt::format("{}; `dynamicfilter {} --help` lists the options", text, command.get_name()));
}

/// What CLI11 says of wrong arguments, in the form of all other errors.
std::string usage_error(const CLI::App* app, const CLI::Error& error) {
    const auto commands = app->get_subcommands();
    const std::string command = commands.empty() ? "" : commands.front()->get_name() + " ";
    return fmt::format("dynamicfilter: {}; `dynamicfilter {}--help` lists the {}\n", error.what(),
                       command, commands.empty() ? "commands" : "options");
}

/// Reads the arguments and does what they say.
int run_command(CLI::App& app, const std::function<int()>& chosen, int argc, char** argv) {
    refuse_unknown_command(app, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // An unknown option is what to say first; that another one is missing may follow from it.
        const bool is_help = error.get_exit_code() == 0;
        if (!is_help && !app.remaining(true).empty()) refuse_unknown_options(app);
        return app.exit(error) == 0 ? kDone : kUsage;
    }
    const int code = chosen();
    // A result that could not be printed (a full disk, say) is not a result.
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        throw OutputError("standard output", "cannot be written");
    }
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    keep_freed_memory();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
    CLI::App app("Removes moving objects from LiDAR scans and maps.", "dynamicfilter");
    app.set_version_flag("--version", DYNAMIC_FILTER_VERSION);
    app.require_subcommand(1);
    app.failure_message(usage_error);
    std::function<int()> chosen;
    add_run(app, chosen);
    add_plan(app, chosen);
    add_merge(app, chosen);
    add_live(app, chosen);
    add_eval(app, chosen);
    add_simulate(app, chosen);
    add_convert(app, chosen);
    add_report(app, chosen);
    add_render(app, chosen);
    add_others(app, chosen);
    return guarded("dynamicfilter", [&] { return run_command(app, chosen, argc, argv); });
}
