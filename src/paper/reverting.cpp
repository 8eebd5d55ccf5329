// SPDX-License-Identifier: MIT
#include "paper/reverting.hpp"

#include <algorithm>

#include "dynamic_filter/parallel.hpp"
#include "geometry/principal_axes.hpp"
#include "paper/submap.hpp"

namespace dynamic_filter {

namespace {

/// The same as fits_static_map(), with a buffer that is reused in a loop.
bool fits(const Point& point, const NeighborGrid& static_map, const FrontEndConfig& config,
          std::vector<Neighbor>& neighbors) {
    static_map.nearest(point, static_cast<std::size_t>(config.revert_neighbors), neighbors);
    if (neighbors.size() < 3) return false;
    Moments moments{.origin = static_map.point(neighbors.front().index)};
    for (const Neighbor& n : neighbors) moments.add(static_map.point(n.index));
    const auto v_static = smallest_axis(moments);
    moments.add(point);
    const auto v_new = smallest_axis(moments);
    if (!v_static || !v_new) return false;
    const double dist = std::min((*v_new - *v_static).norm(), (*v_new + *v_static).norm());
    return dist < config.revert_dist_max;
}

}  // namespace

bool fits_static_map(const Point& point, const NeighborGrid& static_map,
                     const FrontEndConfig& config) {
    std::vector<Neighbor> neighbors;
    return fits(point, static_map, config, neighbors);
}

void revert_by_map(const Window& window, const NeighborGrid& static_map,
                   const FrontEndConfig& config, std::vector<Labels>& labels) {
    parallel_for(window.scans.size(), 1, [&](std::size_t begin, std::size_t end) {
        std::vector<Neighbor> neighbors;
        Points points;
        for (std::size_t s = begin; s < end; ++s) {
            to_map(window.scans[s], points);
            for (std::size_t i = 0; i < points.size(); ++i) {
                if (labels[s][i] == Label::dynamic &&
                    fits(points[i], static_map, config, neighbors)) {
                    labels[s][i] = Label::static_;
                }
            }
        }
    });
}

}  // namespace dynamic_filter
