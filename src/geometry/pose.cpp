// SPDX-License-Identifier: MIT
#include "geometry/pose.hpp"

#include <Eigen/SVD>

namespace dynamic_filter {

Pose mean_pose(std::span<const Pose> poses) {
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    Eigen::Matrix3d rotations = Eigen::Matrix3d::Zero();
    for (const Pose& pose : poses) {
        translation += pose.translation();
        rotations += pose.linear();
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rotations,
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d u = svd.matrixU();
    if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) *= -1.0;
    Pose mean = Pose::Identity();
    mean.linear() = u * svd.matrixV().transpose();
    mean.translation() = translation / static_cast<double>(poses.size());
    return mean;
}

Eigen::Vector3d nearby_origin(const Pose& pose, double step) {
    const double block = 100.0 * step;
    return (pose.translation() / block).array().round() * block;
}

}  // namespace dynamic_filter
