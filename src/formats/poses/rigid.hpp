// SPDX-License-Identifier: MIT
/// Makes rigid motions from untrusted numbers.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "base/text.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Throws InputError at the current line if the quaternion is more than 1 % from unit length.
/// `order` is the expected order of the columns, for the message.
Pose pose_from_quaternion(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation,
                          const std::string& order, const Lines& where);

using Rows34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
/// Makes a rigid motion with an exact rotation. Throws InputError at the current line, with the
/// likely cause, if the left 3x3 block is not a rotation within 1e-3.
Pose pose_from_rows(const Rows34& rows, const Lines& where);

/// The pose for a row with non-finite numbers: the tracking was lost, which is no error.
Pose lost_pose();

}  // namespace dynamic_filter::io
