// SPDX-License-Identifier: MIT
#include "formats/messages/packets.hpp"

#include "dynamic_filter/recording.hpp"
#include "support/tiny_bags.hpp"

namespace dynamic_filter::io {
namespace packets_test {

TEST(Packets, TypesOfBothGenerations) {
    EXPECT_EQ(driver_of("velodyne_msgs/VelodyneScan"), "velodyne_pointcloud");
    EXPECT_EQ(driver_of("velodyne_msgs/msg/VelodyneScan"), "velodyne_pointcloud");
    EXPECT_EQ(driver_of("pandar_msgs/PandarScan"), "hesai_ros_driver");
    EXPECT_EQ(driver_of("rslidar_msg/msg/RslidarPacket"), "rslidar_sdk");
    EXPECT_EQ(driver_of("sensor_msgs/PointCloud2"), "");
}

TEST(Packets, AreNamedWithTheirDriver) {
    const TemporaryFolder data;
    const std::string packets = mcap::schema(1, "velodyne_msgs/msg/VelodyneScan") +
                                mcap::channel(1, 1, "/velodyne_packets") +
                                mcap::schema(2, "ouster_sensor_msgs/PacketMsg") +
                                mcap::channel(2, 2, "/os/lidar_packets");
    const std::string messages =
        mcap::message(1, 5, std::string(99, 'x')) + mcap::message(2, 6, std::string(99, 'x'));
    const auto file = data.put("raw.mcap", mcap::file(packets + messages));
    const std::string error = error_of([&] { (void)open_recording(file); });
    EXPECT_HAS(error, "holds no point clouds");
    EXPECT_HAS(error, "/velodyne_packets holds raw packets (velodyne_msgs/");
    EXPECT_HAS(error, "velodyne_pointcloud");
    EXPECT_HAS(error, "/os/lidar_packets");
    EXPECT_HAS(error, "ouster_ros");
    OpenOptions options;
    options.topic = "/velodyne_packets";
    EXPECT_HAS(error_of<ConfigError>([&] { (void)open_recording(file, options); }), "raw packets");
}

TEST(Packets, CloudsOfOtherTypesAreNamed) {
    const TemporaryFolder data;
    const std::string packed = mcap::schema(1, "point_cloud_interfaces/msg/CompressedPointCloud2") +
                               mcap::channel(1, 1, "/points/draco") +
                               mcap::message(1, 5, std::string(99, 'x'));
    const auto error = [&](const std::string& records) {
        const auto file = data.put("a.mcap", mcap::file(records));
        return error_of([&] { (void)open_recording(file); });
    };
    EXPECT_HAS(error(packed), "/points/draco holds point_cloud_interfaces/CompressedPointCloud2");
    EXPECT_HAS(error(packed), "republish");
    const std::string foxglove = mcap::schema(1, "foxglove.PointCloud") +
                                 mcap::channel(1, 1, "/points", "protobuf") +
                                 mcap::message(1, 5, std::string(99, 'x'));
    EXPECT_HAS(error(foxglove), "/points holds foxglove.PointCloud (protobuf)");
    EXPECT_HAS(error(foxglove), "sensor_msgs/PointCloud2");
    EXPECT_EQ(advice_on_cloud("sensor_msgs/PointCloud2"), "");
}

}  // namespace packets_test
}  // namespace dynamic_filter::io
