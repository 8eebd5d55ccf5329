// SPDX-License-Identifier: MIT
/// The rows of the table of arenas, by files.
#pragma once

#include "arena/arena.hpp"

namespace dynamic_filter::app {

std::vector<Arena> map_arenas();     ///< those that score a map
std::vector<Arena> moving_arenas();  ///< those that score the points of each scan
Arena nuscenes_arena();
Arena kitti_raw_arena();

}  // namespace dynamic_filter::app
