// SPDX-License-Identifier: MIT
/// @file
/// ROS messages as bytes, for BagWriter. Covariances and velocities are zero.
///
/// - Units: [m]; stamps [s], rounded to nanoseconds.
/// - Frames: named by the caller.
/// - Shapes: bytes of one message.
/// - Ownership: values.
/// - Threads: pure functions; thread-safe.
/// - Errors: Error, where a stamp or a text does not fit the message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "dynamic_filter/io/bag.hpp"
#include "dynamic_filter/io/cloud.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// [ns] of a stamp [s], rounded; exact where the double is. Throws Error if not in [0, 2^31 s),
/// which is all that both generations of ROS can say.
std::int64_t to_nanoseconds(double stamp);

/// sensor_msgs/PointCloud2 with the cloud's fields in their order, at `stamp` [s]. It knows no
/// 64-bit integers: those become float64. Throws Error if x, y or z is missing.
std::vector<std::byte> cloud_message(const Cloud& cloud, double stamp, const std::string& frame,
                                     MessageEncoding encoding);

/// tf2_msgs/TFMessage with one transform, at `stamp` [s].
std::vector<std::byte> transform_message(const std::string& parent, const std::string& child,
                                         const Pose& T_parent_child, double stamp,
                                         MessageEncoding encoding);

/// nav_msgs/Odometry of `child` in `parent`, at `stamp` [s].
std::vector<std::byte> odometry_message(const std::string& parent, const std::string& child,
                                        const Pose& T_parent_child, double stamp,
                                        MessageEncoding encoding);

/// geometry_msgs/PoseStamped: a pose in `frame`, at `stamp` [s].
std::vector<std::byte> pose_message(const std::string& frame, const Pose& pose, double stamp,
                                    MessageEncoding encoding);

}  // namespace dynamic_filter::io
