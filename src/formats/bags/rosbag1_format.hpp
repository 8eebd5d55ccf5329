// SPDX-License-Identifier: MIT
/// What the reader and the writer of ROS 1 bags share. Format: ROS bag 2.0.
#pragma once

#include <cstdint>
#include <string_view>

namespace dynamic_filter::io {

constexpr std::string_view kRosbag1Magic = "#ROSBAG V2.0\n";

enum class Rosbag1Opcode : std::uint8_t {
    message = 0x02,
    bag_header,
    index,
    chunk,
    chunk_info,
    connection
};

}  // namespace dynamic_filter::io
