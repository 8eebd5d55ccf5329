// SPDX-License-Identifier: MIT
#include "formats/messages/packets.hpp"

#include <map>

namespace dynamic_filter::io {

std::string driver_of(const std::string& type) {
    static const std::map<std::string, std::string> drivers = {
        {"velodyne_msgs/VelodyneScan", "velodyne_pointcloud"},
        {"velodyne_msgs/VelodynePacket", "velodyne_pointcloud"},
        {"pandar_msgs/PandarScan", "hesai_ros_driver"},
        {"pandar_msgs/PandarPacket", "hesai_ros_driver"},
        {"hesai_lidar/PandarScan", "hesai_ros_driver"},
        {"hesai_ros_driver/UdpFrame", "hesai_ros_driver"},
        {"hesai_ros_driver/UdpPacket", "hesai_ros_driver"},
        {"ouster_ros/PacketMsg", "ouster_ros"},
        {"ouster_msgs/PacketMsg", "ouster_ros"},
        {"ouster_sensor_msgs/PacketMsg", "ouster_ros"},
        {"rslidar_msg/RslidarPacket", "rslidar_sdk"},
        {"rslidar_msg/RslidarScan", "rslidar_sdk"},
        {"rslidar_msgs/rslidarPacket", "rslidar_sdk"},
        {"rslidar_msgs/rslidarScan", "rslidar_sdk"},
        {"livox_ros_driver/LivoxPacket", "livox_ros_driver2"},
    };
    std::string plain = type;
    if (const std::size_t at = plain.find("/msg/"); at != std::string::npos) plain.erase(at, 4);
    const auto found = drivers.find(plain);
    return found == drivers.end() ? "" : found->second;
}

}  // namespace dynamic_filter::io
