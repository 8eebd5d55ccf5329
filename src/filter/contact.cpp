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

ContactSurface towards(const Point& moving, const ContactSurface& plane) {
    if (plane.height(moving) >= 0.0F) return plane;
    return {-plane.normal, -plane.offset, plane.roughness};
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

/// The plane of the static surface, with the normal towards the moving side. Some of the points
/// belong to feet that were not found, and lie above the surface. So the plane is fitted again and
/// again without the points above it, or far below it.
std::optional<ContactSurface> fit(const Points& points, const Point& moving,
                                  const ScansConfig::Contact& config) {
    constexpr int kFits = 3;
    const auto above = static_cast<float>(config.above);
    const auto outlier = static_cast<float>(config.outlier);
    const auto flat = static_cast<float>(config.flat);
    Points inliers = points;
    auto plane = plane_of(points, config);
    for (int round = 0; round < kFits && plane; ++round) {
        const ContactSurface last = towards(moving, *plane);
        inliers.clear();
        for (const Point& p : points) {
            if (last.height(p) <= above && last.height(p) >= -outlier) inliers.push_back(p);
        }
        plane = plane_of(inliers, config);
    }
    if (!plane || 2 * inliers.size() < points.size()) return std::nullopt;
    float sum_sq = 0.0F;
    for (const Point& p : inliers) sum_sq += plane->height(p) * plane->height(p);
    const float roughness = std::sqrt(sum_sq / static_cast<float>(inliers.size()));
    if (roughness > flat) return std::nullopt;
    return towards(moving, {plane->normal, plane->offset, roughness});
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
    const auto surface = fit(fixed, *moving, config);
    // Dynamic voxels on the surface itself have a wrong verdict.
    const bool rises = surface && surface->height(*moving) >= static_cast<float>(config.lowest);
    return rises ? surface : std::nullopt;
}

}  // namespace dynamic_filter
