// SPDX-License-Identifier: MIT
#include "dynamic_filter/poses.hpp"

namespace dynamic_filter::io {
namespace {

/// Rotation between the axes of a camera and those of a LiDAR, without the offset between both.
Pose camera_axes() {
    Pose T_camera_lidar = Pose::Identity();
    T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    return T_camera_lidar;
}

Pose with_rotation(const Pose& pose, const Eigen::Quaterniond& rotation) {
    Pose result = pose;
    result.linear() = rotation.toRotationMatrix();
    return result;
}

/// Of world and sensor, with some axes reversed.
Pose with_axes(const Pose& pose, const Eigen::Vector3d& signs) {
    Pose result = pose;
    result.linear() = signs.asDiagonal() * pose.linear() * signs.asDiagonal();
    result.translation() = signs.cwiseProduct(pose.translation());
    return result;
}

}  // namespace

const std::vector<PoseFix>& pose_fixes() {
    static const std::vector<PoseFix> all = {
        PoseFix::inverse,   PoseFix::camera,      PoseFix::lidar,       PoseFix::wxyz,
        PoseFix::xyzw,      PoseFix::millimetres, PoseFix::centimetres, PoseFix::feet,
        PoseFix::transpose, PoseFix::mirror,      PoseFix::ned,         PoseFix::relative};
    return all;
}

std::string to_string(PoseFix fix) {
    switch (fix) {
        case PoseFix::none:
            break;
        case PoseFix::inverse:
            return "inverse";
        case PoseFix::camera:
            return "camera";
        case PoseFix::lidar:
            return "lidar";
        case PoseFix::wxyz:
            return "wxyz";
        case PoseFix::xyzw:
            return "xyzw";
        case PoseFix::millimetres:
            return "mm";
        case PoseFix::centimetres:
            return "cm";
        case PoseFix::feet:
            return "feet";
        case PoseFix::transpose:
            return "transpose";
        case PoseFix::mirror:
            return "mirror";
        case PoseFix::ned:
            return "ned";
        case PoseFix::relative:
            return "relative";
    }
    return "none";
}

Pose fixed(PoseFix fix, const Pose& pose) {
    const Eigen::Quaterniond q(pose.linear());
    const Pose T_camera_lidar = camera_axes();
    Pose result = pose;
    switch (fix) {
        case PoseFix::none:
        case PoseFix::relative:
            break;
        case PoseFix::inverse:
            return pose.inverse();
        case PoseFix::camera:
            return T_camera_lidar.inverse() * pose * T_camera_lidar;
        case PoseFix::lidar:
            return T_camera_lidar * pose * T_camera_lidar.inverse();
        case PoseFix::wxyz:
            return with_rotation(pose, {q.x(), q.y(), q.z(), q.w()});
        case PoseFix::xyzw:
            return with_rotation(pose, {q.z(), q.w(), q.x(), q.y()});
        case PoseFix::millimetres:
            result.translation() *= 1e-3;
            return result;
        case PoseFix::centimetres:
            result.translation() *= 1e-2;
            return result;
        case PoseFix::feet:
            result.translation() *= 0.3048;
            return result;
        case PoseFix::transpose:
            return with_rotation(pose, q.conjugate());
        case PoseFix::mirror:
            return with_axes(pose, {1.0, -1.0, 1.0});
        case PoseFix::ned:
            return with_axes(pose, {1.0, -1.0, -1.0});
    }
    return pose;
}

std::vector<Pose> chained(std::vector<Pose> motions) {
    Pose T_world_last = Pose::Identity();
    for (Pose& pose : motions) {
        if (!pose.matrix().allFinite()) continue;
        T_world_last = T_world_last * pose;
        pose = T_world_last;
    }
    return motions;
}

}  // namespace dynamic_filter::io
