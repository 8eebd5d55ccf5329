// SPDX-License-Identifier: MIT
/// Raw packets of sensors: what a driver makes clouds of.
#pragma once

#include <string>

namespace dynamic_filter::io {

/// Which driver makes clouds of messages of this type ("velodyne_msgs/VelodyneScan", also with
/// /msg/ in it); empty if they are no packets.
std::string driver_of(const std::string& type);

}  // namespace dynamic_filter::io
