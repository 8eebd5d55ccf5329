// SPDX-License-Identifier: MIT
/// Removert (Kim & Kim, IROS 2020), implemented from its description. The paper compares with it in
/// Tables II and III, and uses its visibility-based reverting in Figure 3. Removert works on a
/// thinned map. For each scan and pixel it tests only the nearest point of the map; points behind
/// that one need another scan.
#pragma once

#include <span>
#include <vector>

#include "paper/visibility_removal.hpp"
#include "paper/window.hpp"

namespace dynamic_filter {

/// Range images of the keyframes of a window at one resolution; parallel to window.keyframes.
using KeyframeImages = std::vector<RangeImage>;

/// Removes points from the map of all measured points, once per resolution of `fine`. Then it tests
/// the removed points in the coarse images, and reverts the points that these do not mark again.
/// The map is thinned to cells of half a voxel. Returns dynamic, static or unknown per scan and
/// point.
std::vector<Labels> removert(const Window& window, std::span<const KeyframeImages> fine,
                             const KeyframeImages& coarse, const RemovalMargin& margin,
                             float voxel_size);

/// The second half of removert(), for points that another removal labelled dynamic: some of them
/// become static again.
void revert_by_visibility(const Window& window, const KeyframeImages& coarse,
                          const RemovalMargin& margin, float voxel_size,
                          std::vector<Labels>& labels);

}  // namespace dynamic_filter
