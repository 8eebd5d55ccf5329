// SPDX-License-Identifier: MIT
/// Where a foot or a wheel stands on the ground, one voxel holds both: there points are judged by
/// the static surface instead.
#pragma once

#include <optional>
#include <span>

#include "dynamic_filter/geometry/voxel.hpp"
#include "dynamic_filter/scans_observe/config.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// A plane `normal . p = offset` whose normal points to the side where things moved.
struct Surface {
    Point normal = Point::Zero();
    float offset = 0.0F;     ///< [m]
    float roughness = 0.0F;  ///< [m] of what lies on it, root mean square
    [[nodiscard]] float height(const Point& p) const { return normal.dot(p) - offset; }
};

/// A voxel within two cells of the one in question, or that one itself.
struct VoxelVerdict {
    Point centroid = Point::Zero();
    Label label = Label::unknown;
    int distance = 0;  ///< in cells, along the farthest axis
};

/// The surface in a static voxel that touches a dynamic one: the plane of the static centroids
/// among `around`. Empty if nothing dynamic touches the voxel, or they are no plane.
std::optional<Surface> contact_surface(std::span<const VoxelVerdict> around,
                                       const ScansConfig::Contact& config);

}  // namespace dynamic_filter
