// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <malloc.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <csignal>

#include "commands.hpp"
#include "dynamic_filter/error.hpp"

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

void add_config_options(CLI::App& command, ConfigOptions& o) {
    command.add_option("--preset", o.preset, "default or paper")->capture_default_str();
    command.add_option("--config", o.file, "TOML file with settings (see `dynamicfilter config`)");
    command.add_option("--set", o.assignments, "one setting, e.g. map.voxel_size=0.1")
        ->take_all()
        ->expected(1);
}

void add_reading_options(CLI::App& command, DataOptions& o) {
    command.add_option("--poses", o.open.poses,
                       "pose file, or none: find them by odometry (default: the recording's own)");
    command.add_option("--format", o.format,
                       "kitti, benchmark, folder or bag (default: recognised)");
    command.add_option("--topic", o.open.topic, "of a bag's scans (default: the only one)");
    command.add_option("--pose-topic", o.open.pose_topic,
                       "of a bag's poses, or /tf (default: chosen)");
    std::vector<std::string> fixes{"none"};
    for (const io::PoseFix fix : io::pose_fixes()) fixes.push_back(io::to_string(fix));
    command
        .add_option("--pose-fix", o.pose_fix,
                    fmt::format("put poses right: {}; `check` says which", fmt::join(fixes, ", ")))
        ->check(CLI::IsMember(fixes));
    command.add_flag("--points-in-world", o.open.points_in_world,
                     "scans are in the frame of the poses, not in the sensor's");
    command.add_option("--time-unit", o.time_unit, "of the stamps: s, ms, us, ns")
        ->check(CLI::IsMember({"s", "ms", "us", "ns"}))
        ->capture_default_str();
    command
        .add_option("--deskew", o.deskew,
                    "undo the sensor's motion during each scan: on, off, or auto: where scans "
                    "overlay better then")
        ->check(CLI::IsMember({"auto", "on", "off"}))
        ->expected(0, 1)
        ->default_str("auto");
}

void add_selection_options(CLI::App& command, DataOptions& o) {
    command.add_option("--first", o.open.first, "index of the first scan")->check(whole_from(0));
    command.add_option("--last", o.open.last, "index of the last scan")->check(whole_from(0));
    command.add_option("--stride", o.open.stride, "use every n-th scan")->check(whole_from(1));
}

void add_run(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<RunOptions>();
    CLI::App& c = *app.add_subcommand("run", "Remove moving objects from a recording");
    c.add_option("DATA", o->data.data, "bag (.mcap, .bag, .db3), or folder with scans and poses")
        ->required();
    c.add_option("-o,--output", o->output, "output folder (default: results/<UTC stamp>)");
    add_reading_options(c, o->data);
    add_config_options(c, o->config);
    add_selection_options(c, o->data);
    c.add_option("--refine", o->refine,
                 "register scans anew, beginning from the given poses: on, off, or auto: where "
                 "scans overlay better then")
        ->check(CLI::IsMember({"auto", "on", "off"}))
        ->capture_default_str();
    c.add_option("--threads", o->threads, "of each stage; 0: all cores")
        ->check(CLI::Range(0, 1024));
    CLI::Option* const online =
        c.add_flag("--online", o->online,
                   "replay as a sensor would; scans that it cannot keep up with are dropped");
    c.add_option("--speed", o->speed,
                 "with --online: times the sensor's rate; 0: as fast as it can, nothing dropped")
        ->needs(online)
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    CLI::Option* const overwrite =
        c.add_flag("--overwrite", o->overwrite,
                   "replace what an earlier run left in the output folder, once this one is done");
    c.add_flag("--resume", o->resume,
               "finish a run that was interrupted or killed, with the bytes of an unbroken one")
        ->excludes(overwrite);
    CLI::Option* const view =
        c.add_flag("--view", o->view, "show the run in a browser, live, at the address it prints");
    c.add_option("--port", o->port, "of the view (default: any that is free)")->needs(view);
    c.add_option("--edits", o->edits,
                 "edits.json of another run, applied to labels and maps (default: the output "
                 "folder's own)");
    c.add_flag("!--no-maps", o->maps, "write no static_map.pcd and no dynamic_points.pcd");
    c.add_flag("!--no-report", o->report, "write no report.html")->excludes(view);
    c.add_flag("-q,--quiet", o->quiet, "say only what is wrong");
    c.callback([o, &chosen] { chosen = [o] { return run(*o); }; });
}

void add_eval(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<EvalOptions>();
    CLI::App& c = *app.add_subcommand("eval", "Score labels or a map against ground truth");
    c.add_option("--truth", o->truth.data, "recording with ground truth")->required();
    CLI::Option_group& result = *c.add_option_group("result");
    result.add_option("--labels", o->labels,
                      "folder of label files, or the output folder of a run");
    result.add_option("--map", o->map, "clean map (.pcd or .ply) in the world frame");
    result.require_option(1);
    add_reading_options(c, o->truth);
    c.add_option("--voxel", o->voxel, "edge of a voxel [m]")
        ->check(CLI::Range(0.01, 10.0))
        ->capture_default_str();
    c.add_option("--json", o->json, "also write the scores here");
    c.callback([o, &chosen] { chosen = [o] { return evaluate(*o); }; });
}

void add_simulate(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<SimulateOptions>();
    auto& s = o->simulation;
    CLI::App& c = *app.add_subcommand("simulate", "Make a recording with exact labels");
    c.add_option("SCENE", s.scene, fmt::format("{}", fmt::join(sim::scene_names(), ", ")))
        ->required();
    c.add_option("-o,--output", o->output, "output folder")->required();
    c.add_option("--pedestrians", s.pedestrians, "how many (default: the scene's own number)");
    c.add_option("--seed", s.seed, "same seed, same bytes")
        ->check(whole_from(0))
        ->capture_default_str();
    c.add_option("--sensor", s.sensor, fmt::format("{}", fmt::join(sim::sensor_names(), ", ")))
        ->capture_default_str();
    c.add_option("--frames", s.frames, "number of scans (default: the whole scene)")
        ->check(whole_from(1));
    c.add_option("--rate", s.rate_hz, "scans per second (default: the scene's own)")
        ->check(CLI::Range(0.0, 100.0));
    c.add_option("--rounds", s.rounds, "of the robot, in crowd (default: 2)")
        ->check(CLI::Range(1, 100));
    c.add_flag(
        "--sweep", s.sweep,
        "measure points one after the other while all moves on, as a real sensor does; scans "
        "are PCD files then, with the time of each point");
    c.add_option("--pose-noise", s.pose_noise_m, "standard deviation of each axis [m]")
        ->check(CLI::Range(0.0, 10.0));
    c.add_option("--pose-noise-deg", s.pose_noise_deg, "standard deviation of each axis [deg]")
        ->check(CLI::Range(0.0, 90.0));
    c.add_flag("--overwrite", o->overwrite, "replace an earlier recording in the output folder");
    c.add_flag("-q,--quiet", o->quiet, "say only what is wrong");
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
    c.add_option("--to", o->to,
                 "layout of a folder: kitti (default), benchmark, or autoware (map tiles)")
        ->check(CLI::IsMember({"kitti", "benchmark", "autoware"}));
    c.add_option("--labels", o->labels,
                 "output folder of a run, or its labels (default: the recording's ground truth)");
    add_reading_options(c, o->data);
    add_selection_options(c, o->data);
    c.add_flag("--overwrite", o->overwrite, "replace what is there");
    c.callback([o, &chosen] { chosen = [o] { return convert(*o); }; });
}

void add_report(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<ReportOptions>();
    CLI::App& c = *app.add_subcommand("report", "Set runs and maps side by side on one page");
    c.add_option("RESULT", o->results,
                 "output folders of runs, or clean maps of others (.pcd, .ply, ...) in the world "
                 "frame; four at most")
        ->required()
        ->expected(1, 4);
    c.add_option("-o,--output", o->output, "the page")->capture_default_str();
    c.add_option("--truth", o->truth.data, "recording with ground truth, to score maps");
    add_reading_options(c, o->truth);
    c.add_option("--voxel", o->voxel, "edge of a voxel for the scores [m]")
        ->check(CLI::Range(0.01, 10.0))
        ->capture_default_str();
    c.callback([o, &chosen] { chosen = [o] { return report(*o); }; });

    auto s = std::make_shared<ServeOptions>();
    CLI::App& serve_command =
        *app.add_subcommand("serve", "Show reports in a browser, on this machine");
    serve_command.add_option("DIR", s->folder, "output folder of a run, or a folder of such")
        ->required();
    serve_command.add_option("--port", s->port, "default: any that is free");
    serve_command.add_flag("--edit", s->edit,
                           "correct verdicts of this one run by hand; saved as DIR/edits.json "
                           "(docs/editing.md)");
    serve_command.callback([s, &chosen] { chosen = [s] { return serve(*s); }; });
}

void add_render(CLI::App& app, std::function<int()>& chosen) {
    auto o = std::make_shared<RenderOptions>();
    CLI::App& c = *app.add_subcommand("render", "Draw a map, or a recording being cleaned");
    c.add_option("IN", o->data.data,
                 "output folder of a run, cloud file, or a recording to animate")
        ->required();
    c.add_option("-o,--output", o->output, ".png; of a recording, .webp")->required();
    CLI::Option* const above = c.add_flag("--top", o->from_above, "from straight above");
    c.add_flag("--clean", o->clean, "without the removed points");
    c.add_option("--width", o->width, "[pixels]")
        ->check(CLI::Range(16, 16384))
        ->capture_default_str();
    c.add_option("--height", o->height, "[pixels]")
        ->check(CLI::Range(16, 16384))
        ->capture_default_str();
    c.add_option("--azimuth", o->azimuth_deg, "direction of view, from the x axis [deg]")
        ->excludes(above)
        ->capture_default_str();
    c.add_option("--elevation", o->elevation_deg, "below the horizon [deg]")
        ->excludes(above)
        ->check(CLI::Range(1.0, 89.0))
        ->capture_default_str();
    c.add_option("--point-size", o->point_size, "[pixels]")
        ->check(CLI::Range(0.5, 50.0))
        ->capture_default_str();
    c.add_option("--pictures", o->pictures, "of an animation")
        ->check(CLI::Range(2, 1000))
        ->capture_default_str();
    add_reading_options(c, o->data);
    add_selection_options(c, o->data);
    add_config_options(c, o->config);
    c.callback([o, &chosen] { chosen = [o] { return render(*o); }; });
}

void add_others(CLI::App& app, std::function<int()>& chosen) {
    auto demo_options = std::make_shared<DemoOptions>();
    CLI::App& d = *app.add_subcommand("demo", "Simulate, filter, score and draw: no data needed");
    d.add_option("-o,--output", demo_options->output, "output folder")->capture_default_str();
    d.callback([=, &chosen] { chosen = [=] { return demo(*demo_options); }; });

    auto data = std::make_shared<DataOptions>();
    CLI::App& check_command =
        *app.add_subcommand("check", "Look for mistakes in a recording's poses, frames and stamps");
    check_command.add_option("DATA", data->data, "recording")->required();
    add_reading_options(check_command, *data);
    add_selection_options(check_command, *data);
    check_command.callback([=, &chosen] { chosen = [=] { return check(*data); }; });

    auto track = std::make_shared<OdometryOptions>();
    CLI::App& o = *app.add_subcommand("odometry", "Find the poses of a recording from its scans");
    o.add_option("DATA", track->data.data, "recording")->required();
    o.add_option("-o,--output", track->output,
                 "pose file: .tum with stamps, otherwise KITTI's rows")
        ->required();
    add_reading_options(o, track->data);
    add_selection_options(o, track->data);
    add_config_options(o, track->config);
    o.add_flag("-q,--quiet", track->quiet, "say only what is wrong");
    o.callback([=, &chosen] { chosen = [=] { return odometry(*track); }; });

    auto file = std::make_shared<std::filesystem::path>();
    CLI::App& i = *app.add_subcommand("info", "Describe a point cloud file or a recording");
    i.add_option("FILE", *file, "cloud or folder")->required();
    i.callback([=, &chosen] { chosen = [=] { return info(*file); }; });

    auto config_options = std::make_shared<ConfigOptions>();
    CLI::App& c = *app.add_subcommand("config", "Print all settings as TOML or JSON");
    add_config_options(c, *config_options);
    auto json = std::make_shared<bool>(false);
    c.add_flag("--json", *json, "as JSON, with bounds");
    c.callback([=, &chosen] { chosen = [=] { return show_config(*config_options, *json); }; });
}

/// CLI11 would only ask for a subcommand.
void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
    const std::string given = argc > 1 ? argv[1] : "-";
    std::vector<std::string> known;
    for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
    if (given.starts_with('-') || std::find(known.begin(), known.end(), given) != known.end()) {
        return;
    }
    throw ConfigError(
        fmt::format("unknown command '{}'; there are: {}", given, fmt::join(known, ", ")));
}

int failed(ExitCode code, const std::exception& error) {
    fmt::print(stderr, "dynamicfilter: {}\n", error.what());
    return code;
}

/// The buffers of a scan come and go with every scan. What is freed stays with the process, and
/// with all of its threads, or the kernel would have to clear new pages again and again.
void keep_freed_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the most that is allowed
    mallopt(M_TRIM_THRESHOLD, 256 << 20);
    mallopt(M_ARENA_MAX, 2);
#endif
}

}  // namespace

int main(int argc, char** argv) {
    keep_freed_memory();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
    CLI::App app("Removes moving objects from LiDAR scans and maps.", "dynamicfilter");
    app.set_version_flag("--version", DYNAMIC_FILTER_VERSION);
    app.require_subcommand(1);
    std::function<int()> chosen;
    add_run(app, chosen);
    add_eval(app, chosen);
    add_simulate(app, chosen);
    add_convert(app, chosen);
    add_report(app, chosen);
    add_render(app, chosen);
    add_others(app, chosen);
    try {
        refuse_unknown_command(app, argc, argv);
        app.parse(argc, argv);
        const int code = chosen();
        // A result that could not be printed (a full disk, say) is not a result.
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
            throw OutputError("standard output", "cannot be written");
        }
        return code;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? kDone : kUsage;
    } catch (const ConfigError& error) {
        return failed(kUsage, error);
    } catch (const InputError& error) {
        return failed(kInput, error);
    } catch (const std::exception& error) {
        return failed(kInternal, error);
    }
}
