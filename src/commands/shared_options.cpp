// SPDX-License-Identifier: MIT
#include "commands/shared_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "recording/data_options.hpp"
#include "recording/layouts/registry.hpp"
#include "run/run.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

void add_recordings(Command& command, RunOptions& options) {
    command
        .paths("DATA", options.city.recordings,
               "a bag (.mcap, .bag, .db3), or a folder with scans and poses; several drives "
               "through one world, or a "
               ".txt file that lists them, give one map")
        .required();
}

void add_reading_options(Command& command, DataOptions& options) {
    command.path(
        "--poses", options.open.poses,
        "pose file; `none` finds the poses by odometry (default: the recording's own poses)");
    command.choice("--format", options.format, io::layout_names(),
                   "layout of the recording (default: recognised by its files)");
    command.text("--topic", options.open.topic,
                 "topic of the scans in a bag (default: the only one)");
    command.text("--pose-topic", options.open.pose_topic,
                 "topic of the poses in a bag, or /tf (default: the one that fits)");
    std::vector<std::string> fixes{"none"};
    for (const io::PoseFix fix : io::pose_fixes()) fixes.push_back(io::to_string(fix));
    command.choice("--pose-fix", options.pose_fix, fixes,
                   "correct the poses; `check` says which correction is needed");
    command.flag("--points-in-world", options.open.points_in_world,
                 "the points are in the world frame, not in the sensor's frame");
    command.choice("--time-unit", options.time_unit, {"s", "ms", "us", "ns"}, "unit of the stamps");
    command.choice_or(
        "--deskew", options.deskew, {"auto", "on", "off"}, "auto",
        "undo the sensor's motion during each scan; auto does so if the scans overlay better then");
}

void add_selection_options(Command& command, DataOptions& options) {
    command.whole("--first", options.open.first, {}, "index of the first scan to use");
    command.whole("--last", options.open.last, {}, "index of the last scan to use");
    command.whole("--stride", options.open.stride, {.low = 1}, "use every n-th scan only");
}

void add_config_options(Command& command, ConfigOptions& options) {
    command.choice("--preset", options.preset, {"default", "paper"},
                   "which settings to begin with");
    command.path("--config", options.file,
                 "TOML file with settings, as `dynamicfilter config` prints them");
    command.words("--set", options.assignments,
                  "change one setting, for instance map.voxel_size=0.1");
}

void add_tile_voxels(Command& command, RunOptions& options) {
    command.whole("--tile-voxels", options.city.tile_voxels, {.low = kFewestTileVoxels},
                  "most voxels in a tile; fewer need less memory, and more time");
}

Option add_threads(Command& command, int& threads) {
    return command.whole("--threads", threads, {.high = 1024},
                         "number of threads; 0 uses all cores");
}

Option add_quiet(Command& command, bool& quiet) {
    return command.flag("-q,--quiet", quiet, "print only warnings and errors");
}

}  // namespace dynamic_filter::app
