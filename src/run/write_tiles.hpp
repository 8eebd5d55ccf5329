// SPDX-License-Identifier: MIT
/// The result of a run over tiles, put together from the tiles: labels, maps and figures of each
/// drive, and the map of all.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "base/output_folder.hpp"
#include "base/stage_clock.hpp"
#include "run/filter_tile.hpp"
#include "run/job.hpp"
#include "run/summary.hpp"

namespace dynamic_filter::app {

/// The folder that holds the files of a tile.
using TileFolders = std::function<std::filesystem::path(const Tile&)>;

inline constexpr const char* kTilesFolder = "tiles";  ///< of a run in progress, and of a part

/// Writes everything that a run leaves, and removes the tiles if they are those of `output`;
/// otherwise they are copied. `clock` is told of the stages. Commits the folder, prints the closing
/// table, and returns the result.
RunResult finish_tiles(const Job& job, const TileFolders& tiles, const RunOptions& options,
                       OutputFolder& output, StageClock& clock);

}  // namespace dynamic_filter::app
