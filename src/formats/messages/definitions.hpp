// SPDX-License-Identifier: MIT
/// Definitions of the message types that are written, because bags must contain them as text.
#pragma once

#include <string>

#include "dynamic_filter/bag.hpp"

namespace dynamic_filter::io {

struct Definition {
    std::string type;  ///< such as "sensor_msgs/PointCloud2"
    std::string md5;   ///< MD5 sum of the ROS 1 definition
};

/// Returns nullptr for a type that is not written.
const Definition* find_definition(const std::string& type);

/// The definition of the message and of all types in it, for ROS 1 or ROS 2 depending on the
/// encoding.
std::string full_definition(const std::string& type, MessageEncoding encoding);

/// Returns a name such as "sensor_msgs/msg/PointCloud2".
std::string ros2_type(const std::string& type);

}  // namespace dynamic_filter::io
