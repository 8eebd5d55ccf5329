// SPDX-License-Identifier: MIT
/// Rigid motions from untrusted numbers.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "dynamic_filter/types.hpp"
#include "text.hpp"

namespace dynamic_filter::io {

/// Throws InputError at the current line if the quaternion is more than 1 % from unit length.
/// `order` says what the columns should be.
Pose pose_from_quaternion(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation,
                          const std::string& order, const Lines& where);

using Rows34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
/// Throws InputError at the current line, with the likely cause, if the left 3x3 block is not a
/// rotation within 1e-3; otherwise makes it exact.
Pose pose_from_rows(const Rows34& rows, const Lines& where);

/// What a row with non-finite numbers becomes: lost tracking, not an error.
Pose lost_pose();

}  // namespace dynamic_filter::io
