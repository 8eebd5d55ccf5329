// SPDX-License-Identifier: MIT
#include "geometry/beam_axis.hpp"

namespace dynamic_filter {

Eigen::Index beam_axis(const Points& points) {
    constexpr double kClearly = 0.5;  // factor of the mean square
    Eigen::Vector3d reach = Eigen::Vector3d::Zero();
    for (const Point& p : points) {
        if (is_measured(p)) reach += p.cast<double>().normalized().cwiseAbs2();
    }
    Eigen::Index least = 2;
    reach.minCoeff(&least);
    return reach[least] < kClearly * reach.z() ? least : 2;
}

Scan turned_to_z(Scan scan, Eigen::Index axis) {
    if (axis == 2) return scan;
    const Eigen::Index x = (axis + 1) % 3, y = (axis + 2) % 3;
    for (Point& p : scan.points) p = Point(p[x], p[y], p[axis]);
    Pose T_sensor_turned = Pose::Identity();
    T_sensor_turned.linear() << Eigen::Vector3d::Unit(x), Eigen::Vector3d::Unit(y),
        Eigen::Vector3d::Unit(axis);
    scan.T_world_sensor = scan.T_world_sensor * T_sensor_turned;
    return scan;
}

}  // namespace dynamic_filter
