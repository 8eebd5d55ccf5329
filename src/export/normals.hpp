// SPDX-License-Identifier: MIT
/// Normals of the surfaces of a cloud, for meshing.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "dynamic_filter/cloud.hpp"

namespace dynamic_filter::app {

/// The names that readers of the file look for: nx ny nz in PLY, normal_x normal_y normal_z else.
std::array<std::string, 3> normal_names(const std::filesystem::path& file);

/// The three fields, of 32-bit floats, hold the direction to the sensor, of any length. Afterwards
/// they hold the unit normal of the plane through the nearest points within `radius` [m], on the
/// side of the sensor; zeros where there is no plane.
/// Runs in all threads of parallel_for(); the result does not depend on them.
void fit_normals(io::Cloud& cloud, const std::array<std::string, 3>& names, double radius);

/// Turns the normals, for instance into the axes of a coordinate system.
void turn_normals(io::Cloud& cloud, const std::array<std::string, 3>& names,
                  const Eigen::Matrix3d& turn);

}  // namespace dynamic_filter::app
