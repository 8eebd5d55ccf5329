// SPDX-License-Identifier: MIT
/// Principal component analysis of a few points.
#pragma once

#include <optional>
#include <span>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Sums from which the covariance follows; adding a point costs a few additions.
/// Offsets are taken from `origin`, so large coordinates lose nothing.
struct Moments {
    Point origin = Point::Zero();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d sum_of_squares = Eigen::Matrix3d::Zero();
    int count = 0;

    void add(const Point& p);
    Moments& operator+=(const Moments& other);  ///< needs the same origin
};

/// Unit eigenvector of the smallest eigenvalue: the normal of the best plane. Its sign is
/// arbitrary. Empty for fewer than three points, or when they do not span a plane (one spot, one
/// line).
std::optional<Eigen::Vector3d> smallest_axis(const Moments& moments);

}  // namespace dynamic_filter
