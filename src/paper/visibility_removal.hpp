// SPDX-License-Identifier: MIT
/// Visibility-based removal (Sec. III-B1).
#pragma once

#include <span>
#include <vector>

#include "dynamic_filter/range_image.hpp"
#include "paper/window.hpp"

namespace dynamic_filter {

/// Minimum difference between the range of a keyframe and that of a point: tau + tau_per_metre * r
/// [m].
struct RemovalMargin {
    float tau = 0.0F, per_metre = 0.0F;
    [[nodiscard]] float at(float range) const { return tau + per_metre * range; }
};

/// The range image of every keyframe in its own sensor frame, with pixels of at least the given
/// steps [rad]. The rows cover the elevations of the scan.
std::vector<RangeImage> keyframe_images(const Window& window, float azimuth_step,
                                        float elevation_step);

/// Initial labels before the removal: static for every measured point, unknown for all others.
Labels label_measured(const Points& points);
std::vector<Labels> label_measured(const Window& window);

/// Tests every point of every scan of the window against every keyframe. A point is dynamic if a
/// keyframe saw farther in its direction by more than the margin. An empty pixel is no evidence.
/// Returns dynamic, static or unknown (not measured) per scan and point. Source: Sec. III-B1.
std::vector<Labels> remove_by_visibility(const Window& window, std::span<const RangeImage> images,
                                         const RemovalMargin& margin);

}  // namespace dynamic_filter
