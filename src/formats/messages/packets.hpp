// SPDX-License-Identifier: MIT
/// Raw packets of sensors, from which a driver makes clouds.
#pragma once

#include <string>

namespace dynamic_filter::io {

/// Name of the driver that makes clouds from messages of this type ("velodyne_msgs/VelodyneScan",
/// also with /msg/ in it); empty if the type is no packet type.
std::string driver_of(const std::string& type);

}  // namespace dynamic_filter::io
