// SPDX-License-Identifier: MIT
// serve_foxglove ros1|cdr: prints what it sends to clients of Foxglove, a line per message as
// message_values.cjs does, and then the address. Ends with its standard input.
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>

#include "dynamic_filter/bag.hpp"
#include "live/foxglove_server.hpp"
#include "peers/sample.hpp"

namespace dynamic_filter::io {
namespace {

constexpr double kStamp = 1.6e9 + 0.25;

class Sender {
public:
    explicit Sender(MessageEncoding encoding)
        : encoding_(encoding), server_(encoding, {.port = 0, .origins = {}}) {
        send_kept();
    }

    [[nodiscard]] std::string url() const { return server_.url(); }

    /// Clouds of several sizes, once, when somebody listens.
    void send_clouds() {
        if (clouds_.empty() || !server_.is_wanted("/points")) return;
        for (const live::Bytes& cloud : std::exchange(clouds_, {})) {
            server_.publish("/points", kStamp, cloud);
        }
    }

private:
    static live::Bytes shared(std::vector<std::byte> data) {
        return std::make_shared<const std::vector<std::byte>>(std::move(data));
    }
    static void print(const char* topic, const char* type, const char* frame,
                      const std::vector<double>& inside) {
        const std::int64_t stamp = to_nanoseconds(kStamp);
        fmt::print("{} {} {} {} {} {} {:08x}\n", topic, type, stamp, stamp, frame, inside.size(),
                   fnv1a(inside));
    }
    void keep(const char* topic, const char* type, const char* frame, std::vector<std::byte> data,
              const std::vector<double>& inside) {
        server_.advertise({topic, type, encoding_}, {.latched = true, .depth = 1});
        server_.publish(topic, kStamp, shared(std::move(data)));
        print(topic, type, frame, inside);
    }

    /// One message of each type, which clients get when they subscribe.
    void send_kept() {
        test::Random random(13);
        const Pose pose = random.pose(100.0, 3.0), next = random.pose(100.0, 3.0);
        const std::vector<double> numbers = pose_values(pose);
        keep("/odom", "nav_msgs/Odometry", "odom",
             odometry_message("odom", "base", pose, kStamp, encoding_), numbers);
        keep("/pose", "geometry_msgs/PoseStamped", "map",
             pose_message("map", pose, kStamp, encoding_), numbers);
        keep("/tf", "tf2_msgs/TFMessage", "map",
             transform_message("map", "base", pose, kStamp, encoding_), numbers);
        std::vector<double> both = numbers;
        const std::vector<double> others = pose_values(next);
        both.insert(both.end(), others.begin(), others.end());
        keep("/path", "nav_msgs/Path", "map",
             path_message("map", {kStamp - 1.0, kStamp}, {pose, next}, encoding_), both);
        keep("/boxes", "visualization_msgs/MarkerArray", "map",
             boxes_message({{{1.0, 2.5, -3.0}, {4.0, 5.0, 6.25}}}, kStamp, "map", encoding_),
             {1.0, 2.5, -3.0, 4.0, 5.0, 6.25});
        keep("/diagnostics", "diagnostic_msgs/DiagnosticArray", "",
             diagnostics_message({{2, "a", "b", "c", {{"1", "2"}, {"3", "4.5"}}}}, kStamp,
                                 encoding_),
             {2.0, 3.0, 7.5});
        server_.advertise({"/points", "sensor_msgs/PointCloud2", encoding_}, {.depth = 100});
        for (const std::size_t points : {0U, 1U, 1000U, 20000U, 100000U}) {
            for (const FieldType type : {FieldType::f32, FieldType::f64}) {
                const Cloud cloud = random_cloud(points, type, random);
                clouds_.push_back(shared(cloud_message(cloud, kStamp, "lidar", encoding_)));
                print("/points", "sensor_msgs/PointCloud2", "lidar", point_values(cloud));
            }
        }
    }

    MessageEncoding encoding_;
    live::FoxgloveServer server_;
    std::vector<live::Bytes> clouds_;
};

}  // namespace
}  // namespace dynamic_filter::io

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    using namespace dynamic_filter::io;
    Sender sender(std::string(argv[1]) == "ros1" ? MessageEncoding::ros1 : MessageEncoding::cdr);
    fmt::print("{}\n", sender.url());
    std::fflush(stdout);
    pollfd input{STDIN_FILENO, POLLIN, 0};
    while (poll(&input, 1, 5) == 0) sender.send_clouds();
    return 0;
}
