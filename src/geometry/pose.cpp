// SPDX-License-Identifier: MIT
#include "geometry/pose.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynamic_filter {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;  // of a degree

}  // namespace

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

Eigen::Matrix3d turned_by(const Eigen::Vector3d& roll_pitch_yaw_deg) {
    const Eigen::Vector3d a = roll_pitch_yaw_deg * kRadians;
    return (Eigen::AngleAxisd(a.z(), Eigen::Vector3d::UnitZ()) *
            Eigen::AngleAxisd(a.y(), Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(a.x(), Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
}

Pose placed(const Eigen::Vector3d& at, const Eigen::Vector3d& roll_pitch_yaw_deg) {
    Pose pose = Pose::Identity();
    pose.translation() = at;
    pose.linear() = turned_by(roll_pitch_yaw_deg);
    return pose;
}

Eigen::Vector3d angles_of(const Eigen::Matrix3d& rotation) {
    const double pitch = std::asin(std::clamp(-rotation(2, 0), -1.0, 1.0));
    const bool is_locked = std::abs(rotation(2, 0)) > 1.0 - 1e-12;  // roll and yaw are one turn
    const double roll = is_locked ? 0.0 : std::atan2(rotation(2, 1), rotation(2, 2));
    const double yaw = is_locked ? std::atan2(-rotation(0, 1), rotation(1, 1))
                                 : std::atan2(rotation(1, 0), rotation(0, 0));
    return Eigen::Vector3d(roll, pitch, yaw) / kRadians;
}

}  // namespace dynamic_filter
