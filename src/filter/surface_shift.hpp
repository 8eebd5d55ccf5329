// SPDX-License-Identifier: MIT
/// How far the surface of an object has moved between two views of it. The middle of an object
/// shifts by metres when the sensor passes it, because another side comes into view. Surfaces that
/// both views show do not.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Points of an object around which its surface is flat, in the map frame.
struct Surface {
    Points points;
    std::vector<Point> normals;  ///< parallel; towards the sensor
};

/// The surface of an object that was seen from a place. Where all points nearby lie on one ring of
/// beams, the surface is taken for upright.
Surface surface_of(const Points& points, const Point& from);

/// A horizontal motion of an object. A wall tells nothing of a motion along it, so each direction
/// has a weight.
struct Shift {
    Eigen::Vector2d by = Eigen::Vector2d::Zero();  ///< [m]
    /// Mean of n n^T over the horizontal parts n of the normals: 1 in a direction that all surfaces
    /// face, and 0 in one that hardly any surface faces.
    Eigen::Matrix2d weight = Eigen::Matrix2d::Zero();
    /// Share of the points that fit, as the sum of n n^T: how well a direction is supported.
    Eigen::Matrix2d support = Eigen::Matrix2d::Zero();
};

/// The motion from the surface to the points, which are seen from `from`: point to plane, robust;
/// `guess` is where the search begins. Only what both views show is compared:
/// - parts of the surface that face away from `from` are left out, because the far side of a post
///   is not its near side after a motion;
/// - a point and a place of the surface must each be the nearest to the other.
/// Empty if too little is left. Thread-safe. Cost: the product of both numbers of points.
std::optional<Shift> shift_to(const Surface& surface, const Points& points, const Point& from,
                              const Eigen::Vector2d& guess);

}  // namespace dynamic_filter
