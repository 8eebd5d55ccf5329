// SPDX-License-Identifier: MIT
/// @file
/// Makes serialized ROS messages for BagWriter. Covariances and velocities are zero.
///
/// - Units: [m]; stamps [s], rounded to nanoseconds.
/// - Frames: the caller names them.
/// - Shapes: the bytes of one message.
/// - Ownership: values.
/// - Threads: pure functions; thread-safe.
/// - Errors: Error if a stamp or a text does not fit into the message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "dynamic_filter/io/bag.hpp"
#include "dynamic_filter/io/cloud.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Converts a stamp [s] to [ns], rounded; exact if the double is. Throws Error if the stamp is not
/// in [0, 2^31 s), the range of both ROS 1 and ROS 2.
std::int64_t to_nanoseconds(double stamp);

/// sensor_msgs/PointCloud2 with the fields of the cloud in their order, at `stamp` [s]. The message
/// type has no 64-bit integers; they become float64. Throws Error if x, y or z is missing.
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

/// nav_msgs/Path: poses in `frame`, each with its stamp [s]; the arrays are parallel. The message
/// has the stamp of the last pose.
std::vector<std::byte> path_message(const std::string& frame, const std::vector<double>& stamps,
                                    const std::vector<Pose>& poses, MessageEncoding encoding);

/// A box for display, with edges along the axes of its frame.
struct BoxMarker {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m]
    Eigen::Vector3d size = Eigen::Vector3d::Ones();    ///< [m]
};

/// visualization_msgs/MarkerArray at `stamp` [s]: removes all earlier markers, then adds a red,
/// half-transparent box for each entry. ROS 2: as of Humble.
std::vector<std::byte> boxes_message(const std::vector<BoxMarker>& boxes, double stamp,
                                     const std::string& frame, MessageEncoding encoding);

/// A row of diagnostic_msgs/DiagnosticStatus.
struct DiagnosticStatus {
    std::uint8_t level = 0;  ///< 0: good, 1: warning, 2: error, 3: no data comes
    std::string name;        ///< of the part that is described
    std::string message;     ///< its state, in a few words
    std::string hardware;    ///< the device, or what is looked at
    std::vector<std::pair<std::string, std::string>> values;  ///< names and values, for display
};

/// diagnostic_msgs/DiagnosticArray at `stamp` [s].
std::vector<std::byte> diagnostics_message(const std::vector<DiagnosticStatus>& statuses,
                                           double stamp, MessageEncoding encoding);

}  // namespace dynamic_filter::io
