// SPDX-License-Identifier: MIT
/// Visibility-based removal (Sec. III-B1).
#pragma once

#include <span>
#include <vector>

#include "dynamic_filter/geometry/range_image.hpp"
#include "dynamic_filter/submaps_observe/window.hpp"

namespace dynamic_filter {

/// How much nearer than the scan's range a point must be: tau + tau_per_metre * r [m].
struct RemovalMargin {
    float tau = 0.0F, per_metre = 0.0F;
    [[nodiscard]] float at(float range) const { return tau + per_metre * range; }
};

/// The range image of every keyframe in its own sensor frame, pixels of at least the given steps
/// [rad]; elevations cover what the scan covers.
std::vector<RangeImage> keyframe_images(const Window& window, float azimuth_step,
                                        float elevation_step);

/// Still for every measured point, unknown for the rest: what is known before anything looked.
Labels label_measured(const Points& points);
std::vector<Labels> label_measured(const Window& window);

/// Looks at every point of every scan of the window from every keyframe: a keyframe that saw
/// farther than the point, by more than the margin, proves it dynamic. An empty pixel is no
/// evidence. Returns per scan and point: dynamic, still, or unknown (not measured).
std::vector<Labels> remove_by_visibility(const Window& window, std::span<const RangeImage> images,
                                         const RemovalMargin& margin);

}  // namespace dynamic_filter
