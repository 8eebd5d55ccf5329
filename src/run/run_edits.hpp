// SPDX-License-Identifier: MIT
/// What `run` does about corrections by hand.
#pragma once

#include <filesystem>
#include <optional>

#include "dynamic_filter/settings.hpp"
#include "run/edits.hpp"
#include "run/run.hpp"

namespace dynamic_filter::app {

/// Those of --edits, or those that lie in the output folder; empty if there are none. Throws
/// InputError and ConfigError before any work is done, where they cannot be read or applied.
std::optional<Edits> edits_for(const std::filesystem::path& output, const RunOptions& options,
                               const Config& config);

/// Into the labels and maps that the run has just written; leaves edits.json beside them.
void apply_to_run(const std::filesystem::path& folder, const Edits& edits, bool quiet);

}  // namespace dynamic_filter::app
