// SPDX-License-Identifier: MIT
/// Upright structures of scans, which show how the sensor moved. The ground is left out, because
/// its rings look the same from everywhere, as if the sensor had not moved.
#pragma once

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// The points of columns that are tall enough, without the lowest ones, 2 to 30 m from the sensor.
/// The z axis is taken as the vertical.
Points upright_points(const Points& points);

/// How much of the upright structures of scan b stands where those of scan a stand, 0..1: the share
/// of columns of 0.3 m; 0 without such columns. Both in their sensor frames.
double upright_overlay(const Points& a, const Points& b, const Pose& T_a_b);

/// The rotation that turns the vertical of a scan into the z axis. Drivers may use other axes, and
/// a sensor may be mounted on its side: then its beams fan out along another axis than z, and along
/// this axis the ground shows more clearly. Otherwise it is exactly the identity.
Eigen::Matrix3d upright_rotation(const Points& points);

}  // namespace dynamic_filter
