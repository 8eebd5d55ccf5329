// SPDX-License-Identifier: MIT
#include "paper/visibility_check.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "dynamic_filter/parallel.hpp"
#include "paper/normals.hpp"

namespace dynamic_filter {

namespace {

/// Nearest pseudo-occupied range per pixel; infinity where there is none.
std::vector<float> pseudo_occupied_bound(const BufferedSubmap& submap, const Projection& seen,
                                         const Point& viewpoint, std::size_t pixels,
                                         const BackEndConfig& config) {
    std::vector<float> bound(pixels, std::numeric_limits<float>::infinity());
    if (!config.incident_correction || submap.normals.empty()) return bound;
    const auto cos_threshold =
        static_cast<float>(std::cos(config.incident_threshold_deg * std::numbers::pi / 180.0));
    for (std::size_t i = 0; i < seen.pixel.size(); ++i) {
        if (seen.pixel[i] < 0) continue;
        float& nearest = bound[static_cast<std::size_t>(seen.pixel[i])];
        if (seen.range[i] < nearest &&
            is_grazing(submap.submap.points[i], submap.normals[i], viewpoint, cos_threshold)) {
            nearest = seen.range[i];
        }
    }
    return bound;
}

}  // namespace

VisibilityBoundary visibility_boundary(const BufferedSubmap& submap, const Pose& T_map_query,
                                       const ImageGrid& grid, const BackEndConfig& config) {
    Projection seen;
    project(submap.submap.points, T_map_query.inverse().cast<float>(), grid, seen);
    const Point viewpoint = T_map_query.translation().cast<float>();
    const auto bound = pseudo_occupied_bound(submap, seen, viewpoint, grid.size(), config);
    VisibilityBoundary farthest(grid.size(), -1.0F);
    for (std::size_t i = 0; i < seen.pixel.size(); ++i) {
        if (seen.pixel[i] < 0) continue;
        const auto pixel = static_cast<std::size_t>(seen.pixel[i]);
        if (seen.range[i] <= bound[pixel]) {
            farthest[pixel] = std::max(farthest[pixel], seen.range[i]);
        }
    }
    const auto depth = static_cast<float>(config.depth_channel);
    for (float& range : farthest) range = range < 0.0F ? -1.0F : depth_channel(range, depth);
    return farthest;
}

std::vector<VisibilityBoundary> check_visibility(std::span<const BufferedSubmap* const> nearby,
                                                 const Pose& T_map_query, const ImageGrid& grid,
                                                 const BackEndConfig& config) {
    std::vector<VisibilityBoundary> boundaries(nearby.size());
    parallel_for(nearby.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t j = begin; j < end; ++j) {
            boundaries[j] = visibility_boundary(*nearby[j], T_map_query, grid, config);
        }
    });
    return boundaries;
}

}  // namespace dynamic_filter
