// SPDX-License-Identifier: MIT
/// What a run leaves for updates of its map, beside the map.
#pragma once

#include <filesystem>

#include "base/output_folder.hpp"
#include "run/job.hpp"

namespace dynamic_filter::app {

inline constexpr const char* kHistoryFolder = "history";

/// Moves the evidence of all tiles and the plan from `tiles` to OUT/evidence, with what tells how
/// the recordings are read.
void keep_evidence(const Job& job, const std::filesystem::path& tiles, const RunOptions& options,
                   const OutputFolder& output);

/// The map of `earlier` becomes the newest one of OUT/history/1, 2 and so on, after those of its
/// own history. Files are linked, so that tiles that stay as they are take no space again.
void keep_history(const std::filesystem::path& earlier, const OutputFolder& output);

}  // namespace dynamic_filter::app
