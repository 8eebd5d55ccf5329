// SPDX-License-Identifier: MIT
#include "commands/shared_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dynamic_filter/parallel.hpp"
#include "recording/data_options.hpp"
#include "run/run.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

void add_recordings(Command& command, RunOptions& options) {
    command
        .paths("DATA", options.recordings,
               "a bag (.mcap, .bag, .db3), or a folder with scans and poses; several drives "
               "through one world, or a "
               ".txt file that lists them, give one map")
        .required();
}

namespace {

void add(Command& command, const std::string& name, const ReadingOption& option,
         std::string& value) {
    if (option.alone != nullptr) {
        command.choice_or(name.c_str(), value, option.choices, option.alone, option.help);
    } else if (!option.choices.empty()) {
        command.choice(name.c_str(), value, option.choices, option.help);
    } else {
        command.text(name.c_str(), value, option.help);
    }
}

void add(Command& command, const std::string& name, const ReadingOption& option,
         std::optional<std::filesystem::path>& value) {
    command.path(name.c_str(), value, option.help);
}

void add(Command& command, const std::string& name, const ReadingOption& option, bool& value) {
    command.flag(name.c_str(), value, option.help);
}

template <class Whole>
void add(Command& command, const std::string& name, const ReadingOption& option, Whole& value) {
    command.whole(name.c_str(), value, {.low = static_cast<double>(option.low)}, option.help);
}

void add_rows(Command& command, DataOptions& options, bool that_select) {
    visit_reading(options, [&](const ReadingOption& option, auto& value) {
        if (option.selects == that_select) add(command, as_option(option), option, value);
    });
}

}  // namespace

void add_reading_options(Command& command, DataOptions& options) {
    add_rows(command, options, false);
}

void add_selection_options(Command& command, DataOptions& options) {
    add_rows(command, options, true);
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
    command.whole("--tile-voxels", options.tile_voxels, {.low = kFewestTileVoxels},
                  "most voxels in a tile; fewer need less memory, and more time");
}

Option add_threads(Command& command, int& threads) {
    return command.whole("--threads", threads, {.high = kMostThreads},
                         "number of threads; 0 uses all cores");
}

Option add_quiet(Command& command, bool& quiet) {
    return command.flag("-q,--quiet", quiet, "print only warnings and errors");
}

}  // namespace dynamic_filter::app
