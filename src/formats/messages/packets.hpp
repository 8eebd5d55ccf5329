// SPDX-License-Identifier: MIT
/// Raw packets of sensors, from which a driver makes clouds, and clouds of types that are not read.
#pragma once

#include <string>

namespace dynamic_filter::io {

/// Name of the driver that makes clouds from messages of this type ("velodyne_msgs/VelodyneScan",
/// also with /msg/ in it); empty if the type is no packet type.
std::string driver_of(const std::string& type);

/// What to do with clouds of a type that is not read
/// ("point_cloud_interfaces/CompressedPointCloud2", "foxglove.PointCloud"); empty if the type is
/// none of a cloud.
std::string advice_on_cloud(const std::string& type);

}  // namespace dynamic_filter::io
