// SPDX-License-Identifier: MIT
/// When a map is cut to what is near the sensor, and to a limit of its size. It is not cut after
/// every scan, because cutting it costs as much as copying it. Single caller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

namespace dynamic_filter {

class Horizon {
public:
    Horizon() = default;
    /// `radius` [m]; 0: no limit. `most`: limit of the size of the map.
    Horizon(double radius, std::size_t most) : radius_(radius > 0.0 ? radius : 1e9), most_(most) {}

    /// What is left of a map that is cut.
    struct Cut {
        double radius = 0.0;   ///< [m] around the sensor
        std::size_t most = 0;  ///< size: three quarters of the limit
    };
    /// Empty: the map is not to be cut yet. `sensor` [m] is where the sensor is now.
    std::optional<Cut> due(const Eigen::Vector3d& sensor, std::size_t size) {
        constexpr double kShareBetween = 0.25;  // of the radius
        if (!cut_at_) cut_at_ = sensor;
        const bool far = (sensor - *cut_at_).norm() > kShareBetween * radius_;
        if (!far && size <= most_) return std::nullopt;
        cut_at_ = sensor;
        return Cut{.radius = radius_, .most = most_ - most_ / 4};
    }

private:
    double radius_ = 1e9;
    std::size_t most_ = SIZE_MAX;
    std::optional<Eigen::Vector3d> cut_at_;  // where the sensor was when the map was last cut
};

}  // namespace dynamic_filter
