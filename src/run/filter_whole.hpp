// SPDX-License-Identifier: MIT
/// Filters one recording whose map fits in memory, and writes what a run leaves of it.
#pragma once

#include "base/output_folder.hpp"
#include "base/stage_clock.hpp"
#include "page/live_view.hpp"
#include "run/job.hpp"
#include "run/summary.hpp"

namespace dynamic_filter::app {

/// Filters the recording of the job into the folder; `clock` is told of the stages, `live` (may be
/// null) of every scan. Afterwards the recording has the poses that were found or refined. Throws
/// InputError if not a single scan is usable.
RunSummary filter_whole(Job& job, const RunOptions& options, const OutputFolder& output,
                        StageClock& clock, LiveView* live);

}  // namespace dynamic_filter::app
