// SPDX-License-Identifier: MIT
#include "tracking/overlay_blur.hpp"

#include <algorithm>
#include <cmath>

#include "tracking/registration.hpp"
#include "tracking/scan_sample.hpp"

namespace dynamic_filter {
namespace {

/// Velocity during scan i. The first scan gets the velocity of the second one.
Twist velocity_at(std::span<const Scan> scans, std::span<const Pose> T_world_sensor,
                  std::size_t i) {
    const std::size_t to = std::max<std::size_t>(i, 1);
    const double dt = scans[to].stamp - scans[to - 1].stamp;
    if (!(dt > 0.0)) return Twist::Zero();
    return log(T_world_sensor[to - 1].inverse() * T_world_sensor[to]) / dt;
}

}  // namespace

double overlay_blur(std::span<const Scan> scans, std::span<const Pose> T_world_sensor,
                    const OdometryConfig& config) {
    if (scans.size() < 2) return 0.0;
    constexpr double kNarrowest = 0.1;  // planes may be tilted, because only roughness counts
    SurfaceMap map(config.voxel, kNarrowest);
    double sum = 0.0;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const ScanSample sample = sample_for_map(scans[i].points, scans[i].times, config);
        const Twist velocity = velocity_at(scans, T_world_sensor, i);
        const Pose T_map_sensor = T_world_sensor.front().inverse() * T_world_sensor[i];
        if (i > 0) {
            const ScanSample few = sample_for_registration(sample, config);
            sum += std::log(blur_on_map(map, few.at_stamp(velocity), T_map_sensor));
        }
        map.insert(moved(sample.at_stamp(velocity), T_map_sensor));
    }
    return std::exp(sum / static_cast<double>(scans.size() - 1));
}

}  // namespace dynamic_filter
