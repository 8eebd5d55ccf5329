// SPDX-License-Identifier: MIT
/// Where a foot or a wheel stands on the ground, one voxel holds both: there points are judged by
/// the static surface instead.
#pragma once

#include <functional>
#include <optional>

#include "dynamic_filter/geometry/voxel.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// A plane `normal . p = offset` whose normal points to the side where things moved.
struct Surface {
    Point normal = Point::Zero();
    float offset = 0.0F;  ///< [m]
    [[nodiscard]] float height(const Point& p) const { return normal.dot(p) - offset; }
};

/// Points of a contact voxel higher than this over its surface are dynamic [m]: beyond the range
/// noise of common sensors.
constexpr float kContactHeight = 0.08F;

/// A neighbouring voxel: its centroid and verdict; empty where there is none.
struct VoxelVerdict {
    Point centroid = Point::Zero();
    Label label = Label::unknown;
};
using VerdictOfCell = std::function<std::optional<VoxelVerdict>(const Cell&)>;

/// The surface in a static voxel that touches a dynamic one: the plane of the static centroids
/// within two cells. Empty if nothing dynamic touches the voxel, or they are no plane.
std::optional<Surface> contact_surface(const Cell& voxel, const VerdictOfCell& verdict_of);

}  // namespace dynamic_filter
