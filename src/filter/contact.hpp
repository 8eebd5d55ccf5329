// SPDX-License-Identifier: MIT
/// Separates moving objects from the static surface on which they stand. Where a foot or a wheel
/// touches the ground, one voxel holds points of both; there each point is judged by its height
/// above the surface.
#pragma once

#include <optional>
#include <span>

#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/types.hpp"
#include "geometry/voxel.hpp"

namespace dynamic_filter {

/// A plane `normal . p = offset`. The normal points to the side of the moving objects.
struct ContactSurface {
    Point normal = Point::Zero();
    float offset = 0.0F;  ///< [m]
    /// [m] root mean square distance of the static centroids from the plane.
    float roughness = 0.0F;
    [[nodiscard]] float height(const Point& p) const { return normal.dot(p) - offset; }
};

/// The verdict on a voxel near the one in question (up to two cells away), or on that voxel itself.
struct VoxelVerdict {
    Point centroid = Point::Zero();
    Label label = Label::unknown;
    int distance = 0;  ///< in cells: the largest of the three coordinate differences
};

/// Fits the static surface in a static voxel that touches a dynamic one: a plane through the static
/// centroids among `around`. Empty if no dynamic voxel touches the voxel, or if the centroids do
/// not lie on a plane. See docs/how-it-works.md, "Feet on the ground".
std::optional<ContactSurface> contact_surface(std::span<const VoxelVerdict> around,
                                              const ScansConfig::Contact& config);

}  // namespace dynamic_filter
