// SPDX-License-Identifier: MIT
#include "dynamic_filter/back_end/contact.hpp"

#include <cmath>
#include <vector>

#include "dynamic_filter/geometry/principal_axes.hpp"

namespace dynamic_filter {

namespace {

constexpr std::size_t kFewest = 6;  // centroids that make a plane
constexpr float kFlat = 0.025F;     // [m] most that they may be off it, root mean square
constexpr float kOutlier = 0.05F;   // [m] a centroid this far off it belongs to something else

struct Neighborhood {
    Points still;                  // centroids
    Point moving = Point::Zero();  // sum of the centroids of dynamic voxels that touch
    int moving_count = 0;
};

Neighborhood look_around(const Cell& voxel, const VerdictOfCell& verdict_of) {
    Neighborhood around;
    for (int x = -2; x <= 2; ++x) {
        for (int y = -2; y <= 2; ++y) {
            for (int z = -2; z <= 2; ++z) {
                const Cell step(x, y, z);
                const auto found = verdict_of(voxel + step);
                if (!found) continue;
                if (found->label == Label::still) around.still.push_back(found->centroid);
                const bool touches = step.cwiseAbs().maxCoeff() <= 1;
                if (touches && found->label == Label::dynamic) {
                    around.moving += found->centroid;
                    ++around.moving_count;
                }
            }
        }
    }
    return around;
}

std::optional<Surface> plane_of(const Points& points) {
    if (points.size() < kFewest) return std::nullopt;
    Moments moments{.origin = points.front()};
    for (const Point& p : points) moments.add(p);
    const auto axis = smallest_axis(moments);
    if (!axis) return std::nullopt;
    const Point mean = moments.origin + (moments.sum / moments.count).cast<float>();
    return Surface{axis->cast<float>(), axis->cast<float>().dot(mean)};
}

/// Fits twice: the second time without what the first plane shows not to belong to it.
std::optional<Surface> fit(const Points& points) {
    const auto first = plane_of(points);
    if (!first) return std::nullopt;
    Points inliers;
    for (const Point& p : points) {
        if (std::abs(first->height(p)) <= kOutlier) inliers.push_back(p);
    }
    const auto second = plane_of(inliers);
    if (!second || 2 * inliers.size() < points.size()) return std::nullopt;
    float sum_sq = 0.0F;
    for (const Point& p : inliers) sum_sq += second->height(p) * second->height(p);
    if (sum_sq > kFlat * kFlat * static_cast<float>(inliers.size())) return std::nullopt;
    return second;
}

}  // namespace

std::optional<Surface> contact_surface(const Cell& voxel, const VerdictOfCell& verdict_of) {
    const Neighborhood around = look_around(voxel, verdict_of);
    if (around.moving_count == 0) return std::nullopt;
    auto surface = fit(around.still);
    if (!surface) return std::nullopt;
    const float side = surface->height(around.moving / static_cast<float>(around.moving_count));
    if (side < 0.0F) *surface = {-surface->normal, -surface->offset};
    return surface;
}

}  // namespace dynamic_filter
