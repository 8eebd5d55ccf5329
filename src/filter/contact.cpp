// SPDX-License-Identifier: MIT
#include "filter/contact.hpp"

#include <cmath>

#include "geometry/principal_axes.hpp"

namespace dynamic_filter {

namespace {

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

std::optional<ContactSurface> plane_of(const Points& points, const ScansConfig::Contact& config) {
    if (points.size() < static_cast<std::size_t>(config.fewest)) return std::nullopt;
    Moments moments{.origin = points.front()};
    for (const Point& p : points) moments.add(p);
    const auto axis = smallest_axis(moments);
    if (!axis) return std::nullopt;
    const Point mean = moments.origin + (moments.sum / moments.count).cast<float>();
    return ContactSurface{axis->cast<float>(), axis->cast<float>().dot(mean), 0.0F};
}

/// Fits a plane twice: the second time without the points that do not lie on the first plane.
std::optional<ContactSurface> fit(const Points& points, const ScansConfig::Contact& config) {
    const auto outlier = static_cast<float>(config.outlier);
    const auto flat = static_cast<float>(config.flat);
    const auto first = plane_of(points, config);
    if (!first) return std::nullopt;
    Points inliers;
    for (const Point& p : points) {
        if (std::abs(first->height(p)) <= outlier) inliers.push_back(p);
    }
    const auto second = plane_of(inliers, config);
    if (!second || 2 * inliers.size() < points.size()) return std::nullopt;
    float sum_sq = 0.0F;
    for (const Point& p : inliers) sum_sq += second->height(p) * second->height(p);
    const float roughness = std::sqrt(sum_sq / static_cast<float>(inliers.size()));
    if (roughness > flat) return std::nullopt;
    return ContactSurface{second->normal, second->offset, roughness};
}

}  // namespace

std::optional<ContactSurface> contact_surface(std::span<const VoxelVerdict> around,
                                              const ScansConfig::Contact& config) {
    const auto moving = moving_side(around);
    if (!moving) return std::nullopt;
    Points fixed;
    for (const VoxelVerdict& v : around) {
        if (v.label == Label::static_) fixed.push_back(v.centroid);
    }
    auto surface = fit(fixed, config);
    if (!surface) return std::nullopt;
    const float height = surface->height(*moving);
    if (std::abs(height) < static_cast<float>(config.lowest))
        // The dynamic voxels lie on the surface itself, so their verdict is wrong.
        return std::nullopt;
    if (height < 0.0F) *surface = {-surface->normal, -surface->offset, surface->roughness};
    return surface;
}

}  // namespace dynamic_filter
