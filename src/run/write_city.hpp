// SPDX-License-Identifier: MIT
/// The results of a city from its tiles: those of each drive, and the map.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "base/output_folder.hpp"
#include "base/stage_clock.hpp"
#include "run/filter_tile.hpp"
#include "run/run_sequence.hpp"

namespace dynamic_filter::app {

/// The folder that holds the files of a tile.
using TileFolders = std::function<std::filesystem::path(const Tile&)>;

struct CitySummary {
    std::vector<RunSummary> drives;
    std::size_t tiles = 0, voxels = 0, keyframes = 0;
    std::size_t visits = 0;  ///< of a tile by a scan
    Seconds seconds;         ///< of the whole process
};

inline constexpr const char* kTilesFolder = "tiles";  ///< of a run in progress, and of a part

/// Writes everything that a run leaves; `clock` is told of the stages. `owns`: the tiles
/// belong to this run alone, so the files of the map are links to theirs, otherwise copies.
CitySummary write_city(const City& city, const TileFolders& tiles, bool owns, const Extras& extras,
                       const OutputFolder& output, StageClock& clock, const Pace& pace, bool quiet);

/// Writes the result, and with `owns` removes the folder of the tiles. Returns the exit code.
int conclude(const City& city, const TileFolders& tiles, bool owns, const RunOptions& options,
             OutputFolder& output, StageClock& clock);

/// The closing table.
std::string to_text(const City& city, const CitySummary& summary);

}  // namespace dynamic_filter::app
