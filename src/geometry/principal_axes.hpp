// SPDX-License-Identifier: MIT
/// Principal component analysis of a few points.
#pragma once

#include <optional>
#include <span>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Sums from which the covariance of points is computed. To add a point takes a few additions.
/// Offsets are taken from `origin`, so that large coordinates lose no precision.
struct Moments {
    Point origin = Point::Zero();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d sum_of_squares = Eigen::Matrix3d::Zero();
    int count = 0;

    void add(const Point& p);
    Moments& operator+=(const Moments& other);  ///< both must have the same origin
};

/// Unit eigenvector of the smallest eigenvalue, which is the normal of the best-fitting plane. Its
/// sign is arbitrary. Empty for fewer than three points, or if the points coincide or lie on one
/// line.
std::optional<Eigen::Vector3d> smallest_axis(const Moments& moments);

}  // namespace dynamic_filter
