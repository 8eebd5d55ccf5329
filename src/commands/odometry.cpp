// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/exit_code.hpp"
#include "base/output_folder.hpp"
#include "base/progress.hpp"
#include "base/say.hpp"
#include "check/motion.hpp"
#include "commands/all.hpp"
#include "commands/shared_options.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/poses.hpp"
#include "recording/data_options.hpp"
#include "recording/scans.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

struct OdometryOptions {
    DataOptions data;
    std::filesystem::path output;
    ConfigOptions config;
    bool overwrite = false, quiet = false;
};

int odometry(const OdometryOptions& o) {
    const Config config = load_config(o.config);
    refuse_existing(o.output, o.overwrite);
    DataOptions without_poses = o.data;
    without_poses.poses = "none";
    io::Recording recording = open(without_poses);
    catch_interrupts();
    ensure_poses(recording, config, {.deskew = o.data.deskew, .quiet = o.quiet});
    if (interrupted()) return kInterrupted;
    write_poses(o.output, recording);
    for (const std::string& line : recording.info().losses) {
        say(stderr, "lost     {}\n", line);
    }
    const int exit_code = recording.info().losses.empty() ? kDone : kRejected;
    if (o.quiet) return exit_code;
    for (const std::string& note : recording.info().notes) say("note     {}\n", note);
    say("written  {}\n", o.output.string());
    return exit_code;
}

}  // namespace

void add_odometry(Program& program) {
    Command c = program.command("odometry", "Find the poses of a recording from its scans");
    const auto o = std::make_shared<OdometryOptions>();
    c.path("DATA", o->data.data, "recording").required();
    c.path("-o,--output", o->output, "pose file: .tum with stamps, otherwise KITTI's rows")
        .required();
    add_reading_options(c, o->data);
    add_selection_options(c, o->data);
    add_config_options(c, o->config);
    c.flag("--overwrite", o->overwrite, "replace an existing file");
    add_quiet(c, o->quiet);
    c.action([o] { return odometry(*o); });
}

}  // namespace dynamic_filter::app
