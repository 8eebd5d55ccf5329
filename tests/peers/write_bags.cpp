// SPDX-License-Identifier: MIT
// Writes a bag and prints what is in it, from what went in: a line per message, as the readers of
// others beside this file print them.
#include <fmt/format.h>

#include <filesystem>

#include "dynamic_filter/bag.hpp"
#include "peers/sample.hpp"

namespace dynamic_filter::io {
namespace {

void write(const std::filesystem::path& path) {
    const auto writer = BagWriter::create(path);
    const MessageEncoding encoding = writer->encoding();
    test::Random random(11);
    std::int64_t recorded = 1'600'000'000'000'000'000;
    const auto put = [&](const char* topic, const char* type, double stamp, const char* frame,
                         const std::vector<std::byte>& data, const std::vector<double>& inside) {
        recorded += 12'345'678;
        writer->write({topic, type, encoding}, recorded, data);
        fmt::print("{} {} {} {} {} {} {:08x}\n", topic, type, recorded, to_nanoseconds(stamp),
                   frame, inside.size(), fnv1a(inside));
    };
    for (std::size_t i = 0; i < 40; ++i) {
        const double stamp = 1.6e9 + 0.1 * static_cast<double>(i);
        const Pose pose = random.pose(100.0, 3.0);
        const auto type = i % 2 == 0 ? FieldType::f32 : FieldType::f64;
        const Cloud cloud = random_cloud(i == 3 ? 0 : 100 * i, type, random);
        put("/points", "sensor_msgs/PointCloud2", stamp, "lidar",
            cloud_message(cloud, stamp, "lidar", encoding), point_values(cloud));
        put("/odom", "nav_msgs/Odometry", stamp, "odom",
            odometry_message("odom", "base", pose, stamp, encoding), pose_values(pose));
        put("/pose", "geometry_msgs/PoseStamped", stamp, "map",
            pose_message("map", pose, stamp, encoding), pose_values(pose));
        const OccupancyCells cells = random_cells(i, random);
        put("/grid", "nav_msgs/OccupancyGrid", stamp, "map",
            occupancy_message(cells, stamp, "map", encoding), cell_values(cells));
        put("/tf", "tf2_msgs/TFMessage", stamp, "map",
            transform_message("map", "base_link", pose, stamp, encoding), pose_values(pose));
    }
    writer->commit();
}

}  // namespace
}  // namespace dynamic_filter::io

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    dynamic_filter::io::write(argv[1]);
    return 0;
}
