// SPDX-License-Identifier: MIT
/// What was seen at one date only, so that nobody can tell whether it changed.
#pragma once

#include <filesystem>

#include "dynamic_filter/cloud.hpp"

namespace dynamic_filter::app {

/// How many voxels of a map of two dates were seen at which.
struct SeenVoxels {
    std::size_t at_both = 0, old_only = 0, new_only = 0;
    io::Cloud unseen;  ///< those of one date, x y z [m] float64; field `seen`: 1 old, 2 new
};

/// `map`: the folder of a map whose first `old_drives` drives are of the old date. A voxel counts
/// as seen at a date if a drive of it has a point in it or in one of its 26 neighbours. Reads the
/// whole map into memory. Throws InputError.
SeenVoxels seen_voxels(const std::filesystem::path& map, std::size_t old_drives);

}  // namespace dynamic_filter::app
