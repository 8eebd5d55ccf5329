// SPDX-License-Identifier: MIT
/// The live filter on any bus: what `dynamicfilter live` and the ROS 1 node share.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "live/bus.hpp"
#include "live/live_config.hpp"

namespace dynamic_filter::live {

struct LiveOptions {
    app::ConfigOptions config;                    ///< the settings of live and of the filter
    std::optional<std::filesystem::path> record;  ///< output folder, completed at the end
    std::optional<std::filesystem::path> map;     ///< saved at SIGUSR1 and at the end
    bool dry_run = false, overwrite = false, quiet = false;
    double look = 5.0;      ///< [s] of listening in a dry run
    bool settings = false;  ///< only prints the settings in force
};

/// Filters what the bus delivers until SIGINT or SIGTERM; in a dry run, says what is there, what
/// fits and what is missing. `config` is what load_live_config() returned for the options. Returns
/// the exit code of the command. Throws ConfigError, OutputError, Error.
int live(Bus& bus, const LiveOptions& options, LiveConfig config);

}  // namespace dynamic_filter::live
