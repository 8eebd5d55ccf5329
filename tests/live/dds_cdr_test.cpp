// SPDX-License-Identifier: MIT
// What Fast DDS and Fast CDR read from the messages that are published.

#include <gtest/gtest.h>

#include <iomanip>
#include <sstream>

#include "dynamic_filter/bag.hpp"
#include "live/dds_bus.hpp"
#include "live/dds_support.hpp"
#include "live/peer_process.hpp"

namespace dynamic_filter::live {
namespace dds_cdr_test {

/// The fields as the peer prints them; a char stands for a byte.
class Fields {
public:
    template <class... Values>
    Fields& add(const Values&... values) {
        (put(values), ...);
        return *this;
    }
    Fields& pose(const Pose& pose) {
        const Eigen::Quaterniond q(pose.linear());
        for (const double value : pose.translation()) put(value);
        return add(q.x(), q.y(), q.z(), q.w());
    }
    Fields& zeros(int count) {
        for (int i = 0; i < count; ++i) put(0);
        return *this;
    }
    [[nodiscard]] std::string text() const { return out_.str(); }

private:
    template <class Value>
    void put(const Value& value) {
        if constexpr (std::is_arithmetic_v<Value>) {
            out_ << std::setprecision(17) << +value << ' ';
        } else {
            out_ << '"' << value << "\" ";
        }
    }
    std::ostringstream out_;
};

Pose some_pose(double x) {
    Pose pose(Eigen::AngleAxisd(0.3, Eigen::Vector3d(0.2, -0.4, 1.0).normalized()));
    pose.translation() << x, -2.25, 1e-9;
    return pose;
}

struct DdsCdr : testing::Test {
    ReservedDomain domain;
    DdsBus bus{{.domain = domain.number(), .network = "localhost"}};

    /// What a peer reads, without the number of bytes behind the end.
    std::string decoded(const std::string& type, const std::vector<std::byte>& message) {
        bus.advertise({"/message", type, io::MessageEncoding::cdr},
                      {.reliable = true, .latched = true, .depth = 1});
        bus.publish("/message", 0.0, std::make_shared<const std::vector<std::byte>>(message));
        PeerProcess peer({FASTDDS_PEER, "decode", "domain=" + std::to_string(domain.number()),
                          "latched=1", "topic=rt/message", "type=" + dds_type_name(type)});
        EXPECT_TRUE(eventually([&] { return !peer.said("got").empty(); }));
        const std::string got = peer.said("got").at(0);
        const std::size_t left = got.rfind("left ");
        EXPECT_LT(std::stoi(got.substr(left + 5)), 4) << "only padding is left";
        return got.substr(0, left);
    }
};

constexpr auto kCdr = io::MessageEncoding::cdr;

TEST_F(DdsCdr, Cloud) {
    io::Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) io::add_field(cloud, axis, io::FieldType::f32);
    io::add_field(cloud, "ring", io::FieldType::u8);
    io::add_field(cloud, "time", io::FieldType::f64);
    for (int i = 0; i < 42; ++i) cloud.data.push_back(static_cast<std::byte>(i));
    Fields expected;
    expected.add(1700000000, 125000000, "lidar", 1, 2, 5);
    expected.add("x", 0, 7, 1, "y", 4, 7, 1, "z", 8, 7, 1, "ring", 12, 2, 1, "time", 13, 8, 1);
    expected.add(0, 21, 42, 42);
    for (int i = 0; i < 42; ++i) expected.add(i);
    expected.add(1);
    EXPECT_EQ(
        decoded("sensor_msgs/PointCloud2", io::cloud_message(cloud, 1700000000.125, "lidar", kCdr)),
        expected.text());
}

TEST_F(DdsCdr, Transform) {
    const Pose pose = some_pose(10.5);
    EXPECT_EQ(decoded("tf2_msgs/TFMessage", io::transform_message("map", "odom", pose, 5.25, kCdr)),
              Fields().add(1, 5, 250000000, "map", "odom").pose(pose).text());
}

TEST_F(DdsCdr, Odometry) {
    const Pose pose = some_pose(3.0);
    EXPECT_EQ(
        decoded("nav_msgs/Odometry", io::odometry_message("odom", "base_link", pose, 7.5, kCdr)),
        Fields().add(7, 500000000, "odom", "base_link").pose(pose).zeros(36 + 6 + 36).text());
}

TEST_F(DdsCdr, Path) {
    const std::vector<Pose> poses{some_pose(1.0), some_pose(2.0)};
    EXPECT_EQ(decoded("nav_msgs/Path", io::path_message("map", {1.5, 2.5}, poses, kCdr)),
              Fields()
                  .add(2, 500000000, "map", 2, 1, 500000000, "map")
                  .pose(poses[0])
                  .add(2, 500000000, "map")
                  .pose(poses[1])
                  .text());
}

TEST_F(DdsCdr, Occupancy) {
    const io::OccupancyCells cells{0.25, 3, 1, {1.0, 2.0, 3.0}, {0, 100, -1}};
    EXPECT_EQ(decoded("nav_msgs/OccupancyGrid", io::occupancy_message(cells, 1.5, "map", kCdr)),
              Fields()
                  .add(1, 500000000, "map", 1, 500000000, 0.25F, 3, 1)
                  .pose(Pose(Eigen::Translation3d(cells.origin)))
                  .add(3, 0, 100, -1)
                  .text());
}

TEST_F(DdsCdr, Markers) {
    const io::BoxMarker box{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
    const auto marker = [](Fields& fields, int id, int action, const io::BoxMarker& shown) {
        fields.add(9, 0, "map", "removed", id, 1, action)
            .pose(Pose(Eigen::Translation3d(shown.center)));
        for (const double size : shown.size) fields.add(size);
        fields.add(0.9F, 0.1F, 0.1F, 0.5F, 1, 0, 0, 0, 0);
        fields.add("", 0, 0, "", "", 0, 0, "", "", "", 0, 0);
    };
    Fields expected;
    expected.add(2);
    marker(expected, 0, 3, {});
    marker(expected, 1, 0, box);
    EXPECT_EQ(decoded("visualization_msgs/MarkerArray", io::boxes_message({box}, 9.0, "map", kCdr)),
              expected.text());
}

TEST_F(DdsCdr, Diagnostics) {
    const io::DiagnosticStatus good{0, "filter", "runs", "", {{"scans", "12"}, {"late", ""}}};
    const io::DiagnosticStatus bad{2, "poses", "none come", "gnss", {}};
    EXPECT_EQ(
        decoded("diagnostic_msgs/DiagnosticArray", io::diagnostics_message({good, bad}, 3.0, kCdr)),
        Fields()
            .add(3, 0, "", 2, 0, "filter", "runs", "", 2, "scans", "12", "late", "")
            .add(2, "poses", "none come", "gnss", 0)
            .text());
}

}  // namespace dds_cdr_test
}  // namespace dynamic_filter::live
