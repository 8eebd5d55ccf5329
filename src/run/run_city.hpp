// SPDX-License-Identifier: MIT
/// Runs over several recordings of one world, or over one that is larger than memory: the area is
/// cut into tiles, and each is filtered on its own. docs/city.md explains it.
#pragma once

#include "run/run.hpp"

namespace dynamic_filter::app {

/// True if tiles are needed: several recordings, a part, MPI, or a limit of the memory.
bool is_city(const RunOptions& options);

int run_city(const RunOptions& options);

}  // namespace dynamic_filter::app
