// SPDX-License-Identifier: MIT
/// Removert (Kim & Kim, IROS 2020), written from its description: the opponent of Tables II and
/// III, and the visibility-based reverting of Figure 3. It looks at a thinned map, and per scan and
/// pixel only at the map's nearest point: what stands behind that one needs another scan.
#pragma once

#include <span>
#include <vector>

#include "dynamic_filter/submaps_observe/visibility_removal.hpp"
#include "dynamic_filter/submaps_observe/window.hpp"

namespace dynamic_filter {

/// Images of the window's keyframes at one resolution; parallel to window.keyframes.
using KeyframeImages = std::vector<RangeImage>;

/// Removes from the map of all measured points, once per resolution; then looks at what was removed
/// in the coarse images and takes back what they do not mark again. Cells have half a voxel's edge.
/// Returns dynamic, still or unknown per scan and point.
std::vector<Labels> removert(const Window& window, std::span<const KeyframeImages> fine,
                             const KeyframeImages& coarse, const RemovalMargin& margin,
                             float voxel_size);

/// The second half of it, for points that another removal made dynamic: turns some of them to
/// still.
void revert_by_visibility(const Window& window, const KeyframeImages& coarse,
                          const RemovalMargin& margin, float voxel_size,
                          std::vector<Labels>& labels);

}  // namespace dynamic_filter
