// SPDX-License-Identifier: MIT
/// The message types that are written, as bags must spell them out.
#pragma once

#include <string>

#include "dynamic_filter/io/bag.hpp"

namespace dynamic_filter::io {

struct Definition {
    std::string type;  ///< "sensor_msgs/PointCloud2"
    std::string md5;   ///< of ROS 1's definition
};

/// nullptr for a type that is not written.
const Definition* find_definition(const std::string& type);

/// The message and all it is made of, as the encoding's generation of ROS defines them.
std::string full_definition(const std::string& type, MessageEncoding encoding);

/// "sensor_msgs/msg/PointCloud2".
std::string ros2_type(const std::string& type);

}  // namespace dynamic_filter::io
