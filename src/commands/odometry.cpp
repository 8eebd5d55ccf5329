// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <functional>
#include <optional>

#include "base/exit_code.hpp"
#include "base/output_folder.hpp"
#include "base/progress.hpp"
#include "base/say.hpp"
#include "check/choose_poses.hpp"
#include "check/motion.hpp"
#include "check/place_drive.hpp"
#include "commands/all.hpp"
#include "commands/shared_options.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/poses.hpp"
#include "recording/data_options.hpp"
#include "recording/scans.hpp"
#include "run/update.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

struct OdometryOptions {
    DataOptions data;
    std::filesystem::path output;
    std::optional<std::filesystem::path> onto;  ///< result of a run
    ConfigOptions config;
    bool overwrite = false, quiet = false;
};

/// The recording with these poses, by scan; those that are not finite are not known.
io::Recording at_poses(const io::Recording& recording,
                       const std::function<std::optional<Pose>(std::size_t)>& pose_of) {
    std::vector<std::optional<Tracked>> tracked(recording.size());
    for (std::size_t i = 0; i < recording.size(); ++i) {
        const std::optional<Pose> pose = pose_of(i);
        if (pose && pose->matrix().allFinite()) tracked[i].emplace().T_world_sensor = *pose;
    }
    return io::with_poses(recording, tracked);
}

/// The recording with the poses that place it in the world of the map. Returns what was done, in a
/// sentence.
std::string place_onto(io::Recording& recording, const std::filesystem::path& map) {
    const std::vector<Drive> drives = drives_of_map(map);
    std::vector<const io::Recording*> recordings;
    for (const Drive& drive : drives) recordings.push_back(&drive.recording);
    const io::PlacedDrive placed = io::place_drive(recording, recordings);
    if (placed.places == 0) {
        throw ConfigError(
            fmt::format("{} was not found on the map in {}: no place looks like its own",
                        recording.info().root.string(), map.string()));
    }
    if (!placed.fits()) {
        throw ConfigError(
            fmt::format("{} does not fit to the map in {}: of {} places that both pass, {} lie on "
                        "each other, with "
                        "{:.0f} % of their points, and scans of the map saw through {:.0f} % of "
                        "what stands there",
                        recording.info().root.string(), map.string(), placed.places, placed.fitting,
                        100.0 * placed.fit, 100.0 * placed.through));
    }
    recording = at_poses(recording, [&](std::size_t i) { return placed.T_world_sensor[i]; });
    return fmt::format("{} of {} places lie on the map, with {:.0f} % of their points; {}",
                       placed.fitting, placed.places, 100.0 * placed.fit,
                       placed.is_found
                           ? std::string("the drive was found on it by what places look like")
                           : fmt::format("poses moved by up to {:.2f} m", placed.moved));
}

/// Poses that stand in the files of the scans are known then without reading these.
io::Recording with_known_poses(const io::Recording& recording) {
    if (recording.info().T_world_sensor.size() == recording.size()) return recording;
    return at_poses(recording, [&](std::size_t i) -> std::optional<Pose> {
        const io::FullScan scan = recording.read(i);
        return scan.has_pose ? std::optional(scan.T_world_sensor) : std::nullopt;
    });
}

/// Without poses, or with those of the recording if it is to be placed on a map by them.
io::Recording open_to_track(const OdometryOptions& o, Config config) {
    if (o.onto) {
        io::Recording given = open(o.data);
        if (given.info().has_poses && io::scans_without_pose(given).empty()) {
            choose_motion(given, config, {.refine = "off", .deskew = o.data.deskew});
            return with_known_poses(given);
        }
    }
    DataOptions without_poses = o.data;
    without_poses.poses = "none";
    io::Recording recording = open(without_poses);
    ensure_poses(recording, config, {.deskew = o.data.deskew, .quiet = o.quiet});
    return recording;
}

int odometry(const OdometryOptions& o) {
    const Config config = load_config(o.config);
    refuse_existing(o.output, o.overwrite);
    catch_interrupts();
    io::Recording recording = open_to_track(o, config);
    if (interrupted()) return kInterrupted;
    std::string placed;
    if (o.onto) placed = place_onto(recording, *o.onto);
    if (interrupted()) return kInterrupted;
    write_poses(o.output, recording);
    for (const std::string& line : recording.info().losses) {
        say(stderr, "lost     {}\n", line);
    }
    const int exit_code = recording.info().losses.empty() ? kDone : kRejected;
    if (o.quiet) return exit_code;
    for (const std::string& note : recording.info().notes) say("note     {}\n", note);
    if (!placed.empty()) say("placed   {}\n", placed);
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
    c.path("--onto", o->onto,
           "output folder of a run: the poses are those in its world, from the recording's own "
           "poses if it has some, else from what places look like");
    add_reading_options(c, o->data);
    add_selection_options(c, o->data);
    add_config_options(c, o->config);
    c.flag("--overwrite", o->overwrite, "replace an existing file");
    add_quiet(c, o->quiet);
    c.action([o] { return odometry(*o); });
}

}  // namespace dynamic_filter::app
