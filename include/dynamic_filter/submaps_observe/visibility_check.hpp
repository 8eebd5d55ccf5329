// SPDX-License-Identifier: MIT
/// The visibility check that stands in for ray tracing (Sec. III-C2, Algorithm 1).
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "dynamic_filter/geometry/range_image.hpp"
#include "dynamic_filter/submaps_observe/config.hpp"
#include "dynamic_filter/submaps_observe/submap_buffer.hpp"

namespace dynamic_filter {

/// Index of the depth channel that holds a range; with depth 0 the range itself is the channel.
inline float depth_channel(float range, float depth) {
    return depth > 0.0F ? std::floor(range / depth) : range;
}

/// Per pixel the depth channel of the visibility boundary; -1 where the submap has no point.
using VisibilityBoundary = std::vector<float>;

/// Algorithm 1 for one submap seen from p_q: the farthest range of a pixel that is not behind its
/// nearest pseudo-occupied point. (As printed, the second loop would overwrite that bound; the text
/// says that points beyond it are not taken into account.)
VisibilityBoundary visibility_boundary(const BufferedSubmap& submap, const Pose& T_map_query,
                                       const ImageGrid& grid, const BackEndConfig& config);

/// The boundaries D_I of all submaps; submaps are independent and run in parallel.
std::vector<VisibilityBoundary> check_visibility(std::span<const BufferedSubmap* const> nearby,
                                                 const Pose& T_map_query, const ImageGrid& grid,
                                                 const BackEndConfig& config);

}  // namespace dynamic_filter
