// SPDX-License-Identifier: MIT
/// Measures how the scans of two drives lie to each other at one place.
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/recording.hpp"
#include "tracking/registration.hpp"

namespace dynamic_filter::io {

constexpr double kRoundedDegree = 3.14159265358979 / 180.0;  ///< [rad] from 15 digits of pi
constexpr double kSameTilt = 0.5 * kRoundedDegree;           ///< [rad] of drives in one world

/// Information about a correction: x, y, z [m] and the turn about z [rad].
using FlatInformation = Eigen::Matrix4d;

/// The scans of drive b fit those of drive a when they are turned by `yaw` about the vertical
/// through `at` and then shifted by `shift`.
struct PlaceOffset {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();     ///< [m] world: the sensor of drive b
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< [m] world
    double yaw = 0.0;                                 ///< [rad] counterclockwise
    FlatInformation information = FlatInformation::Zero();
    double fit = 0.0;  ///< 0..1: share of the points of b that lie on surfaces of a
    /// The same correction with its tilt: of the points of b relative to the place, and what is
    /// known about a displacement, with the axes of the world.
    Pose motion = Pose::Identity();
    Information of_motion = Information::Zero();
    /// False: no correction within reach makes the scans fit.
    [[nodiscard]] bool fits() const;
};

/// What is known about a displacement with the axes of the world, as one of the sensor.
Information in_sensor(const Information& of_world, const Pose& T_world_sensor);

/// Points of a few scans, relative to a place and with the axes of the world. Empty if no scan can
/// be read.
Points cloud_around(const Recording& recording, const std::vector<std::size_t>& scans,
                    const Eigen::Vector3d& place);

/// Registers the points of drive b to those of drive a; both are relative to the place. Finds
/// horizontal corrections up to 6 m and 6 deg, and any height of which the ground tells. Empty if
/// one of the clouds shows too little. `tilt` [rad]: by how much the verticals of both may differ.
std::optional<PlaceOffset> register_clouds(const Points& a, const Points& b,
                                           const Eigen::Vector3d& place, double tilt = kSameTilt);

}  // namespace dynamic_filter::io
