// SPDX-License-Identifier: MIT
/// Finds places that a recording passes more than once.
#pragma once

#include <vector>

#include "dynamic_filter/recording.hpp"
#include "tracking/pose_graph.hpp"

namespace dynamic_filter::io {

/// How the scans of a later passage lie in the frames of those of an earlier one, wherever the
/// poses of the recording pass a place again within 10 m after a way of 50 m or more. Scans of both
/// passages are registered to each other; horizontal errors of the poses up to 6 m and 6 deg are
/// found. Reads about ten scans a place, at most 100 places.
std::vector<Motion> find_loops(const Recording& recording);

}  // namespace dynamic_filter::io
