// SPDX-License-Identifier: MIT
/// Filters one tile.
#pragma once

#include <filesystem>

#include "run/job.hpp"

namespace dynamic_filter::app {

/// Filters a tile from all scans that reach it, drive by drive, and writes its two files into
/// `folder`: the verdicts on the points inside of it, and its part of the map. The bytes depend on
/// nothing but the recordings, the settings and the tile. False if it was interrupted; no file is
/// left then. Memory: the voxels of the tile and its surroundings, and the images of keyframes.
bool filter_tile(const Job& job, const TileWork& work, const std::filesystem::path& folder);

}  // namespace dynamic_filter::app
