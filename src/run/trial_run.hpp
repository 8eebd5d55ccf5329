// SPDX-License-Identifier: MIT
/// A run on a part of the scans and points, which shows before the real one what the watch would
/// find.
#pragma once

#include <vector>

#include "check/watch.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/settings.hpp"

namespace dynamic_filter::app {

/// Filters up to 40 consecutive scans at each of up to three places, with every n-th point, and
/// returns what the watch finds there. The recording must have poses.
std::vector<io::Alarm> try_run(const io::Recording& recording, const Config& config);

}  // namespace dynamic_filter::app
