// SPDX-License-Identifier: MIT
#include "dynamic_filter/back_end/contact.hpp"

#include <cmath>

#include "dynamic_filter/geometry/principal_axes.hpp"

namespace dynamic_filter {

namespace {

constexpr std::size_t kFewest = 6;  // centroids that make a plane
constexpr float kFlat = 0.025F;     // [m] most that they may be off it, root mean square
constexpr float kLowest = 0.03F;    // [m] that something on the surface rises over it
constexpr float kOutlier = 0.05F;   // [m] a centroid this far off it belongs to something else

/// Mean centroid of the dynamic voxels that touch this one.
std::optional<Point> moving_side(std::span<const VoxelVerdict> around) {
    Point sum = Point::Zero();
    int count = 0;
    for (const VoxelVerdict& v : around) {
        if (v.label != Label::dynamic || v.distance > 1) continue;
        sum += v.centroid;
        ++count;
    }
    if (count == 0) return std::nullopt;
    return Point(sum / static_cast<float>(count));
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

std::optional<Surface> contact_surface(std::span<const VoxelVerdict> around) {
    const auto moving = moving_side(around);
    if (!moving) return std::nullopt;
    Points still;
    for (const VoxelVerdict& v : around) {
        if (v.label == Label::still) still.push_back(v.centroid);
    }
    auto surface = fit(still);
    if (!surface) return std::nullopt;
    const float height = surface->height(*moving);
    if (std::abs(height) < kLowest) return std::nullopt;  // part of the surface, judged wrongly
    if (height < 0.0F) *surface = {-surface->normal, -surface->offset};
    return surface;
}

}  // namespace dynamic_filter
