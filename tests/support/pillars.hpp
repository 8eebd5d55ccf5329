// SPDX-License-Identifier: MIT
/// A field of pillars, whose scans overlay only at the right poses.
#pragma once

#include <cmath>

#include "dynamic_filter/cloud.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {

/// A scan of the pillars with x y z; in the world frame if `in_world`.
inline Cloud pillars_seen_from(const Pose& T_world_sensor, bool in_world = false) {
    constexpr int kPillars = 80, kPoints = 12;
    Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, FieldType::f32);
    std::string bytes;
    for (int k = 0; k < kPillars; ++k) {
        // Irregular places within 24 m.
        const double angle = 2.4 * k, range = 4.0 + std::fmod(7.31 * k, 20.0);
        for (int i = 0; i < kPoints; ++i) {
            const Eigen::Vector3d p(range * std::cos(angle), range * std::sin(angle),
                                    -1.0 + 0.2 * i);
            const Eigen::Vector3d seen = in_world ? p : T_world_sensor.inverse() * p;
            bytes += floats({static_cast<float>(seen.x()), static_cast<float>(seen.y()),
                             static_cast<float>(seen.z())});
        }
    }
    const auto raw = std::as_bytes(std::span(bytes));
    cloud.data.assign(raw.begin(), raw.end());
    return cloud;
}

/// A curve at 2 m a scan, 0.1 rad.
inline Pose on_a_curve(double scan) {
    const double angle = 0.1 * scan;
    return Pose(Eigen::Translation3d(6.0 * std::sin(angle), 6.0 - 6.0 * std::cos(angle), 0.0) *
                Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}

}  // namespace dynamic_filter::io
