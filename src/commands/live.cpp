// SPDX-License-Identifier: MIT
#include "commands/live.hpp"

#include <fmt/format.h>

#include "base/exit_code.hpp"
#include "base/say.hpp"
#include "commands/all.hpp"
#include "live/ask.hpp"
#include "live/dds_bus.hpp"
#include "live/ros2_arguments.hpp"

namespace dynamic_filter::app {

namespace {

struct Options : live::LiveOptions {
    std::vector<std::string> ros_arguments;
    std::string request;  ///< of another process
};

int print_answer(live::DdsBus& bus, const std::string& prefix, const std::string& request) {
    const live::ServiceAnswer answer = live::ask(bus, prefix, request);
    say("{}\n", answer.message);
    return answer.success ? kDone : kRejected;
}

int live_on_dds(const Options& options) {
    const live::LiveConfig config =
        live::load_live_config(options.config, live::ros2_parameters(options.ros_arguments));
    live::DdsBus bus({.domain = config.bus.domain, .network = config.bus.network});
    if (!options.request.empty()) return print_answer(bus, config.output.prefix, options.request);
    return live::live(bus, options, config);
}

}  // namespace

void add_live_options(Command& command, live::LiveOptions& options) {
    command.path("LIVE", options.config.file,
                 "TOML file with settings of live and of the filter (default: none)");
    command.words("--set", options.config.assignments,
                  "change one setting, for instance input.cloud=/points");
    command.choice("--preset", options.config.preset, {"default", "paper"},
                   "which settings of the filter to begin with");
    const Option dry_run =
        command.flag("--dry-run", options.dry_run,
                     "publish nothing; say what there is, what fits, and what is missing");
    command.number("--look", options.look, {0.1, 3600.0}, "with --dry-run: how long to listen [s]")
        .needs(dry_run);
    Option record = command.path(
        "-o,--record", options.record,
        "also write the drive to a bag beside this folder and, after Ctrl-C, the result of `run` "
        "to the folder");
    record.excludes(dry_run);
    command
        .path("--map", options.map,
              "write the static map to this cloud at SIGUSR1, while the filter goes on, and at the "
              "end")
        .excludes(dry_run);
    command.flag("--overwrite", options.overwrite, "replace an earlier --record or --map");
    command.flag("--settings", options.settings, "print the settings of live as TOML, and end");
    command.flag("-q,--quiet", options.quiet, "print only warnings and errors");
}

void add_live(Program& program) {
    Command c = program.command(
        "live", "Filter what a robot's LiDAR publishes by ROS 2, and publish the result");
    const auto o = std::make_shared<Options>();
    add_live_options(c, *o);
    c.text("--ask", o->request,
           "ask a running filter, and print its answer: save, save=NAME, reset, pause or resume");
    c.rest_after("--ros-args", o->ros_arguments);
    c.footer(
        "Arguments of ROS 2 may follow the word --ros-args: -p input.cloud:=/points,\n"
        "--params-file FILE, -r __node:=NAME, -r __ns:=/NAMESPACE.");
    c.action([o] { return live_on_dds(*o); });
}

}  // namespace dynamic_filter::app
