// SPDX-License-Identifier: MIT
/// The options that `dynamicfilter live` and the ROS 1 node share.
#pragma once

#include <CLI/CLI.hpp>

#include "live/live.hpp"

namespace dynamic_filter::live {

/// `options` must outlive `command`.
inline void add_live_options(CLI::App& command, LiveOptions& options) {
    command.add_option("LIVE", options.file,
                       "TOML file with settings of live and of the filter (default: none)");
    command
        .add_option("--set", options.assignments,
                    "change one setting, for instance input.cloud=/points")
        ->take_all()
        ->expected(1);
    command.add_option("--preset", options.preset, "which settings of the filter to begin with")
        ->type_name("{default,paper}")
        ->capture_default_str();
    CLI::Option* const dry_run =
        command.add_flag("--dry-run", options.dry_run,
                         "publish nothing; say what there is, what fits, and what is missing");
    command.add_option("--look", options.look, "with --dry-run: how long to listen [s]")
        ->needs(dry_run)
        ->check(CLI::Range(0.1, 3600.0))
        ->capture_default_str();
    CLI::Option* const record = command.add_option(
        "--record", options.record,
        "also write the drive to a bag beside this folder and, after Ctrl-C, the result of `run` "
        "to the folder");
    record->excludes(dry_run);
    command.add_flag("--overwrite", options.overwrite, "replace an earlier --record")
        ->needs(record);
    command.add_flag("--settings", options.settings, "print the settings of live as TOML, and end");
    command.add_flag("-q,--quiet", options.quiet, "print only warnings and errors");
}

}  // namespace dynamic_filter::live
