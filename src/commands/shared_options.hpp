// SPDX-License-Identifier: MIT
/// Options that several commands have.
#pragma once

#include "commands/options.hpp"
#include "recording/data_options.hpp"
#include "run/run.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

/// The recordings of a run: one or several; a list of them counts as several.
void add_recordings(Command& command, RunOptions& options);
/// How to read a recording.
void add_reading_options(Command& command, DataOptions& options);
/// Which of its scans.
void add_selection_options(Command& command, DataOptions& options);
/// Settings of the filter.
void add_config_options(Command& command, ConfigOptions& options);
void add_tile_voxels(Command& command, RunOptions& options);
Option add_threads(Command& command, int& threads);
Option add_quiet(Command& command, bool& quiet);

}  // namespace dynamic_filter::app
