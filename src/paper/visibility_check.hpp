// SPDX-License-Identifier: MIT
/// The visibility check that replaces ray tracing (Sec. III-C2, Algorithm 1).
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "dynamic_filter/range_image.hpp"
#include "dynamic_filter/settings.hpp"
#include "paper/submap_buffer.hpp"

namespace dynamic_filter {

/// Index of the depth channel that contains a range. With depth 0, the range itself is the index.
inline float depth_channel(float range, float depth) {
    return depth > 0.0F ? std::floor(range / depth) : range;
}

/// Depth channel of the visibility boundary per pixel; -1 where the submap has no point.
using VisibilityBoundary = std::vector<float>;

/// Computes Algorithm 1 for one submap seen from the query pose p_q. The boundary of a pixel is its
/// farthest range that is not behind the nearest pseudo-occupied point of the pixel. (In the
/// printed algorithm, the second loop would overwrite this bound. The text of the paper says that
/// points beyond it are not used, and this function follows the text.)
VisibilityBoundary visibility_boundary(const BufferedSubmap& submap, const Pose& T_map_query,
                                       const ImageGrid& grid, const BackEndConfig& config);

/// Computes the boundaries D_I of all submaps in parallel.
std::vector<VisibilityBoundary> check_visibility(std::span<const BufferedSubmap* const> nearby,
                                                 const Pose& T_map_query, const ImageGrid& grid,
                                                 const BackEndConfig& config);

}  // namespace dynamic_filter
