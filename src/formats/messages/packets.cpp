// SPDX-License-Identifier: MIT
#include "formats/messages/packets.hpp"

#include <map>

namespace dynamic_filter::io {

namespace {

/// The type as ROS 1 writes it.
std::string without_msg(const std::string& type) {
    std::string plain = type;
    if (const std::size_t at = plain.find("/msg/"); at != std::string::npos) plain.erase(at, 4);
    return plain;
}

}  // namespace

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
    const auto found = drivers.find(without_msg(type));
    return found == drivers.end() ? "" : found->second;
}

std::string advice_on_cloud(const std::string& type) {
    const std::string plain = without_msg(type);
    if (plain == "point_cloud_interfaces/CompressedPointCloud2") {
        return "play the bag to `ros2 run point_cloud_transport republish` with "
               "out_transport:=raw, and "
               "record the sensor_msgs/PointCloud2 that it publishes";
    }
    if (plain == "sensor_msgs/PointCloud") {
        return "play the bag to a node that publishes sensor_msgs/PointCloud2, such as "
               "point_cloud_converter, and record that";
    }
    if (plain == "foxglove.PointCloud" || plain == "foxglove_msgs/PointCloud" ||
        plain == "foxglove.CompressedPointCloud") {
        return "write the clouds as sensor_msgs/PointCloud2 (ros1 or cdr), or as .pcd files";
    }
    return "";
}

}  // namespace dynamic_filter::io
