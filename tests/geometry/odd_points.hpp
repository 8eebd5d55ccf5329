// SPDX-License-Identifier: MIT
/// Points with every kind of coordinate that a scan may hold, and a pose, for tests of the voxels.
#pragma once

#include <cstddef>
#include <limits>

#include "dynamic_filter/types.hpp"
#include "support/random.hpp"

namespace dynamic_filter::test {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInf = std::numeric_limits<float>::infinity();

inline Points points_of_all_kinds(std::size_t count) {
    Random random(11);
    Points points = {{0, 0, 0},     {kNan, 0, 0},       {0, -kInf, 0}, {1, 2, kNan},
                     {3e38F, 0, 0}, {1e9F, 0, 0},       {0, 0, -2e5F}, {1e-20F, 0, 0},
                     {-1e5F, 1, 1}, {0.2F, -0.2F, 0.4F}};
    while (points.size() < count) {
        const float reach = points.size() % 3 == 0 ? 2e5F : 50.0F;
        points.emplace_back(random.uniform_f(-reach, reach), random.uniform_f(-reach, reach),
                            random.uniform_f(-5.0F, 5.0F));
    }
    return points;
}

inline Pose somewhere() {
    Pose pose = Pose::Identity();
    pose.translation() = Eigen::Vector3d(3.7, -12.1, 0.9);
    pose.linear() =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.1, 0.2, 1.0).normalized()).toRotationMatrix();
    return pose;
}

}  // namespace dynamic_filter::test
