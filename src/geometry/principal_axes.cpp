// SPDX-License-Identifier: MIT
#include "geometry/principal_axes.hpp"

#include <Eigen/Eigenvalues>

namespace dynamic_filter {

void Moments::add(const Point& p) {
    const Eigen::Vector3d offset = (p - origin).cast<double>();
    sum += offset;
    sum_of_squares += offset * offset.transpose();
    ++count;
}

Moments& Moments::operator+=(const Moments& other) {
    sum += other.sum;
    sum_of_squares += other.sum_of_squares;
    count += other.count;
    return *this;
}

std::optional<Eigen::Vector3d> smallest_axis(const Moments& moments) {
    if (moments.count < 3) return std::nullopt;
    const Eigen::Vector3d mean = moments.sum / moments.count;
    const Eigen::Matrix3d covariance =
        moments.sum_of_squares / moments.count - mean * mean.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(covariance);
    const Eigen::Vector3d& values = solver.eigenvalues();  // ascending
    // The middle spread must be clearly larger than rounding errors; otherwise the axis is
    // arbitrary.
    if (!(values[1] > 1e-6 * values[2]) || !(values[2] > 1e-12)) return std::nullopt;
    return solver.eigenvectors().col(0);
}

}  // namespace dynamic_filter
