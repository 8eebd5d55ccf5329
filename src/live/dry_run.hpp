// SPDX-License-Identifier: MIT
/// What `live --dry-run` says: what is there, what fits, and what is missing.
#pragma once

#include "live/bus.hpp"
#include "live/live_config.hpp"

namespace dynamic_filter::live {

/// Listens for `look` [s], publishes nothing, and prints what it found. Returns kDone if scans with
/// poses came, or else kRejected.
int dry_run(Bus& bus, const LiveConfig& config, double look);

}  // namespace dynamic_filter::live
