// SPDX-License-Identifier: MIT
/// All that the tiles of a run have in common.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dynamic_filter/settings.hpp"
#include "recording/drives.hpp"
#include "run/plan.hpp"
#include "run/run.hpp"

namespace dynamic_filter::app {

struct City {
    Config config;
    std::vector<Drive> drives;
    Plan plan;        ///< empty until it is made or read
    std::string run;  ///< what the run was begun with: the mark of its files
};

/// Opens the drives. Throws ConfigError if an option does not go with tiles.
City open_city(const std::vector<DriveSource>& sources, const RunOptions& options);

/// What a folder was begun with, for run_state.hpp.
std::string state_of_output(const City& city, const RunOptions& options);

/// Tells the user what the plan found in the drives.
void tell_notes(const City& city, bool quiet);

}  // namespace dynamic_filter::app
