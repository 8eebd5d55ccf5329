// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

#include "live.hpp"

namespace dynamic_filter::live {

/// The options that `dynamicfilter live` and the ROS 1 node share. `options` must outlive
/// `command`.
inline void add_live_options(CLI::App& command, LiveOptions& options) {
    command.add_option("LIVE", options.file,
                       "TOML file with the settings of topics, output and filter");
    command
        .add_option("--set", options.assignments,
                    "change one setting, for instance map.voxel_size=0.1")
        ->take_all()
        ->expected(1);
    command.add_option("--preset", options.preset, "which settings to begin with")
        ->type_name("{default,paper}")
        ->capture_default_str();
    CLI::Option* const record = command.add_option(
        "--record", options.record, "folder for the result, as `dynamicfilter run` leaves it");
    command
        .add_flag("--overwrite", options.overwrite,
                  "replace an earlier result in the folder of --record")
        ->needs(record);
    CLI::Option* const dry_run = command.add_flag(
        "--dry-run", options.dry_run, "only say which topics are there, fit, or are missing");
    command.add_option("--look", options.look, "with --dry-run: how long to listen [s]")
        ->needs(dry_run)
        ->check(CLI::Range(0.1, 3600.0))
        ->capture_default_str();
    command.add_flag("-q,--quiet", options.quiet, "print only warnings and errors")
        ->excludes(dry_run);
}

}  // namespace dynamic_filter::live
