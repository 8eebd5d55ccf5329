// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Eigenvalues>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::test {

/// Eigenvalues and vectors of the covariance, in two passes and by the iterative solver.
inline Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> reference_axes(const Points& points) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Point& p : points) mean += p.cast<double>() / static_cast<double>(points.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Point& p : points) {
        const Eigen::Vector3d d = p.cast<double>() - mean;
        covariance += d * d.transpose() / static_cast<double>(points.size());
    }
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance);
}

}  // namespace dynamic_filter::test
