// SPDX-License-Identifier: MIT
/// Company: what moves beside the sensor wherever that goes, such as the person who steers a robot.
/// It is no part of the own body, because it is not fixed to the sensor.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// The dynamic points in sectors around the sensor, of 15 deg from the x axis on, seen along the z
/// axis of the sensor frame.
struct DynamicBeside {
    static constexpr std::size_t kSectors = 24;
    using Sums = Eigen::Matrix<double, 2, kSectors>;
    std::array<std::size_t, kSectors> points{};        ///< their numbers
    Sums sums = Sums::Zero();                          ///< [m] of their x and y
    Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< [m] in the world
};

/// Counts the dynamic points that are 0.5 to 5 m from the sensor. `points` are in the sensor frame,
/// `labels` parallel to them.
DynamicBeside dynamic_beside(const Points& points, const Pose& T_world_sensor,
                             const Labels& labels);

/// A sentence on what goes along with the sensor; empty if nothing does. In a crowd, something
/// dynamic is on all sides, and nothing is said; nor of what stays at its place, such as a part of
/// the vehicle that is not in the boxes of the own body. Scans are in order.
std::optional<std::string> company_of(std::span<const DynamicBeside> scans);

}  // namespace dynamic_filter::io
