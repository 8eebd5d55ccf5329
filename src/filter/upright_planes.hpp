// SPDX-License-Identifier: MIT
/// Finds upright planes, such as the fronts of houses, among points seen from above.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace dynamic_filter {

/// The places p with `normal . p = offset`, at any height, along which points were found from
/// `from` to `until` [m], measured along the plane (see along()).
struct UprightPlane {
    Eigen::Vector2f normal = Eigen::Vector2f::UnitX();
    float offset = 0.0F;
    float from = 0.0F, until = 0.0F;
    [[nodiscard]] float height(const Eigen::Vector2f& p) const { return normal.dot(p) - offset; }
    [[nodiscard]] float along(const Eigen::Vector2f& p) const {
        return normal.x() * p.y() - normal.y() * p.x();
    }
};

/// The planes with the most points, at most `most` of them and each with at least `least_points`
/// of its own (Hough transform, then a fit to the points nearby). The order of the points matters
/// only in rounding.
std::vector<UprightPlane> upright_planes(std::vector<Eigen::Vector2f> points, std::size_t most,
                                         int least_points);

}  // namespace dynamic_filter
