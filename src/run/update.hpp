// SPDX-License-Identifier: MIT
/// `run --update`: the map of an earlier run goes on with other drives. The result is the map that
/// a run of all drives would leave. What the earlier run kept (evidence_file.hpp) spares the work
/// of filtering its drives again.
#pragma once

#include "run/job.hpp"
#include "run/run.hpp"

namespace dynamic_filter::app {

struct Update {
    Job job;             ///< of all drives: first those of the earlier run
    RunOptions options;  ///< the recordings are read, and filtered, as the earlier run did
};

/// Writes nothing. Throws ConfigError and InputError, also if a new drive does not fit to those of
/// the map.
Update open_update(const RunOptions& options);

/// The drives of a map, or of any other result of a run, opened as the run read them. Throws
/// InputError and ConfigError as open_update() does.
std::vector<Drive> drives_of_map(const std::filesystem::path& result);

/// The plan of the earlier run of an update; empty if it kept none.
Plan earlier_plan(const Job& job);

}  // namespace dynamic_filter::app
