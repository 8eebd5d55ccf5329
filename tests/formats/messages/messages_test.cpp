// SPDX-License-Identifier: MIT
#include "dynamic_filter/bag.hpp"

#include "formats/byte_reader.hpp"
#include "formats/messages/definitions.hpp"
#include "formats/messages/message_writer.hpp"
#include "formats/messages/messages.hpp"
#include "support/bag_support.hpp"

namespace dynamic_filter::io {
namespace messages_test {

constexpr std::array kEncodings = {MessageEncoding::ros1, MessageEncoding::cdr};

Topic topic(const std::string& type, MessageEncoding encoding) { return {"/a", type, encoding}; }

CloudMessage read_cloud(std::span<const std::byte> data, MessageEncoding encoding) {
    return read_cloud_message(data, topic("sensor_msgs/PointCloud2", encoding));
}

template <class Read>
auto read_as(const std::string& type, MessageEncoding encoding, std::span<const std::byte> data,
             Read read) {
    const Topic of = topic(type, encoding);
    return read(Message{of, 0, {}, data});
}

/// A PointCloud2 as others write it: everything can be set wrong.
struct Wire {
    struct WireField {
        std::string name;
        std::uint32_t offset;
        std::uint8_t type;
        std::uint32_t count = 1;
    };
    std::uint32_t height = 1, width = 2, point_step = 12, row_step = 24;
    bool big_endian = false;
    std::vector<WireField> fields = {{"x", 0, 7}, {"y", 4, 7}, {"z", 8, 7}};
    std::string data = floats({1, 2, 3, 4, 5, 6});
    std::string frame = "lidar";

    [[nodiscard]] std::vector<std::byte> bytes(MessageEncoding encoding) const {
        MessageWriter out(encoding);
        if (encoding == MessageEncoding::ros1) out.number(std::uint32_t{9});
        out.number(std::uint32_t{5});
        out.number(std::uint32_t{250'000'000});
        out.text(frame);
        out.number(height);
        out.number(width);
        out.number(static_cast<std::uint32_t>(fields.size()));
        for (const WireField& field : fields) {
            out.text(field.name);
            out.number(field.offset);
            out.number(field.type);
            out.number(field.count);
        }
        out.number(static_cast<std::uint8_t>(big_endian));
        out.number(point_step);
        out.number(row_step);
        out.bytes(as_byte_span(data));
        out.number(std::uint8_t{1});
        return out.moved_bytes();
    }
    [[nodiscard]] Cloud read() const {
        const Cloud cloud = read_cloud(bytes(MessageEncoding::ros1), MessageEncoding::ros1).cloud;
        const Cloud other = read_cloud(bytes(MessageEncoding::cdr), MessageEncoding::cdr).cloud;
        EXPECT_EQ(cloud.fields, other.fields);
        EXPECT_EQ(cloud.data, other.data);
        return cloud;
    }
    [[nodiscard]] std::string error() const {
        return error_of<Malformed>([&] { (void)read(); });
    }
};
const Points two_points = {{1, 2, 3}, {4, 5, 6}};

TEST(WireCloud, Plain) {
    const Wire wire;
    EXPECT_EQ(positions(wire.read()), two_points);
    const auto message = read_cloud(wire.bytes(MessageEncoding::cdr), MessageEncoding::cdr);
    EXPECT_EQ(message.header.stamp, 5.25);
}

TEST(WireCloud, EveryTruncationIsRefused) {
    for (const MessageEncoding encoding : kEncodings) {
        const auto bytes = Wire{}.bytes(encoding);
        for (std::size_t n = 0; n + 1 < bytes.size(); ++n) {  // the last says nothing of interest
            EXPECT_THROW(read_cloud(std::span(bytes).first(n), encoding), Malformed) << n;
        }
    }
}

TEST(WireCloud, LeadingSlashOfFrames) {
    Wire wire;
    wire.frame = "/lidar";
    for (const MessageEncoding encoding : kEncodings) {
        EXPECT_EQ(read_cloud(wire.bytes(encoding), encoding).header.frame, "lidar");
    }
}

TEST(WireCloud, SizesThatDoNotFit) {
    Wire wire;
    wire.point_step = 11;
    EXPECT_HAS(wire.error(), "'z' ends at byte 12 of points of 11");
    wire = {};
    wire.fields[1].count = 4'000'000'000;
    EXPECT_HAS(wire.error(), "'y' ends at byte");
    wire = {};
    wire.fields[1].offset = 4'294'967'292;
    EXPECT_HAS(wire.error(), "'y' ends at byte");
    wire = {};
    wire.width = 3;
    EXPECT_HAS(wire.error(), "need 36 bytes, but it holds 24");
    wire = {};
    wire.data.pop_back();
    EXPECT_HAS(wire.error(), "need 24 bytes, but it holds 23");
    wire = {};
    wire.height = 2;
    wire.width = 1;
    wire.row_step = 8;
    EXPECT_HAS(wire.error(), "rows have 8 bytes");
    wire = {};
    wire.height = wire.width = wire.row_step = 0xFFFFFFFFU;
    EXPECT_HAS(wire.error(), "rows have");
    wire = {};
    wire.height = 0xFFFFFFFFU;
    EXPECT_HAS(wire.error(), "need");
    wire = {};
    wire.point_step = wire.row_step = 0;
    wire.fields.clear();
    wire.width = wire.height = 0xFFFFFFFFU;
    EXPECT_HAS(wire.error(), "");
}

TEST(WireCloud, FieldsThatMakeNoPoints) {
    Wire wire;
    wire.fields[0].type = 9;
    EXPECT_HAS(wire.error(), "unknown type 9");
    wire.fields[0].type = 0;
    EXPECT_HAS(wire.error(), "unknown type 0");
    wire = {};
    wire.fields[2].name = "w";
    EXPECT_HAS(wire.error(), "no field 'z'");
    wire = {};
    wire.fields[2].type = 6;
    EXPECT_HAS(wire.error(), "'z' is not float32 or float64");
}

TEST(WireCloud, OverlappingFieldsDoNotMultiplyTheData) {
    Wire wire;
    wire.point_step = 1U << 20U;
    wire.width = 1;
    wire.row_step = wire.point_step;
    wire.data.assign(wire.point_step, '\0');
    for (int i = 0; i < 1000; ++i) {
        wire.fields.push_back({"f" + std::to_string(i), 0, 2, wire.point_step});
    }
    EXPECT_HAS(wire.error(), "overlap");
}

TEST(WireCloud, TheSameBytesUnderTwoNames) {
    Wire wire;
    wire.fields.push_back({"height", 8, 7});
    EXPECT_EQ(column(wire.read(), "height"), (std::vector<double>{3, 6}));
}

TEST(WireCloud, MissingRowStepAndCountsAreRepaired) {
    Wire wire;
    wire.row_step = 0;
    for (auto& field : wire.fields) field.count = 0;
    EXPECT_EQ(positions(wire.read()), two_points);
}

TEST(WireCloud, BigEndian) {
    Wire wire;
    wire.big_endian = true;
    wire.data = floats({1, 2, 3, 4, 5, 6}, true);
    EXPECT_EQ(positions(wire.read()), two_points);
}

TEST(WireCloud, BigEndianCdr) {
    std::vector<std::byte> data = pose_message("map", Pose::Identity(), 0.0, MessageEncoding::cdr);
    data[1] = std::byte{0};
    std::reverse(data.begin() + 12, data.begin() + 16);  // the length of the frame
    EXPECT_EQ(read_as("geometry_msgs/PoseStamped", MessageEncoding::cdr, data, read_header).frame,
              "map");
    data[1] = std::byte{3};
    EXPECT_THROW(read_as("geometry_msgs/PoseStamped", MessageEncoding::cdr, data, read_header),
                 Malformed);
}

TEST(WireCloud, NoPoints) {
    Wire wire;
    wire.width = wire.row_step = 0;
    wire.data.clear();
    EXPECT_EQ(wire.read().size(), 0U);
    wire.height = 0;
    wire.width = 7;
    EXPECT_EQ(wire.read().size(), 0U);
}

TEST(WireCloud, TakenNamesAndPadding) {
    Wire wire;
    wire.point_step = 25;
    wire.row_step = 50;
    wire.fields = {{"", 0, 2, 1}, {"_", 1, 2, 3}, {"z", 4, 7},  {"y", 8, 7},
                   {"x", 12, 7},  {"a_2", 16, 7}, {"a", 20, 2}, {"a", 21, 2}};
    const std::string point = "pppp" + floats({3, 2, 1, 9}) + "abccc";
    wire.data = point + point;
    const Cloud cloud = wire.read();
    EXPECT_EQ(positions(cloud), (Points{{1, 2, 3}, {1, 2, 3}}));
    EXPECT_EQ(cloud.point_bytes, 18U);
    std::vector<std::string> names;
    for (const Field& field : cloud.fields) names.push_back(field.name);
    EXPECT_EQ(names, (std::vector<std::string>{"z", "y", "x", "a_2", "a", "a_3"}));
    EXPECT_EQ(column(cloud, "a_3"), (std::vector<double>(2, 'b')));
}

TEST(WireCloud, OrganisedWithPaddedRowsAndHoles) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Wire wire;
    wire.height = 2;
    wire.row_step = 30;
    wire.data = floats({1, 2, 3, nan, nan, nan}) + "pppppp" + floats({4, 5, 6, 7, 8, 9});
    const Points points = positions(wire.read());
    ASSERT_EQ(points.size(), 4U);
    EXPECT_EQ(points[0], Point(1, 2, 3));
    EXPECT_FALSE(points[1].allFinite());
    EXPECT_EQ(points[2], Point(4, 5, 6));
    EXPECT_EQ(points[3], Point(7, 8, 9));
}

TEST(WireCloud, Float64Coordinates) {
    Wire wire;
    wire.point_step = 16;
    wire.row_step = 32;
    wire.fields = {{"x", 0, 8}, {"y", 8, 7}, {"z", 12, 7}};
    wire.data = bytes_of(1.0) + floats({2, 3}) + bytes_of(4.0) + floats({5, 6});
    const Cloud cloud = wire.read();
    EXPECT_EQ(positions(cloud), two_points);
    EXPECT_EQ(cloud.find("x")->type, FieldType::f64);
}

TEST(Livox, Points) {
    for (const MessageEncoding encoding : kEncodings) {
        MessageWriter out(encoding);
        if (encoding == MessageEncoding::ros1) out.number(std::uint32_t{0});
        out.number(std::uint32_t{7});
        out.number(std::uint32_t{0});
        out.text("/livox_frame");
        out.number(std::uint64_t{7'000'000'000});
        out.number(std::uint32_t{2});
        for (int i = 0; i < 4; ++i) out.number(std::uint8_t{1});
        out.number(std::uint32_t{2});
        for (const float base : {1.0F, 4.0F}) {
            out.number(static_cast<std::uint32_t>(1000.0F * base));
            for (const float axis : {0.0F, 1.0F, 2.0F}) out.number(base + axis);
            for (const int value : {10, 20, 30}) out.number(static_cast<std::uint8_t>(value));
        }
        const auto data = out.moved_bytes();
        for (const char* type : {"livox_ros_driver/CustomMsg", "livox_ros_driver2/CustomMsg"}) {
            const CloudMessage message = read_cloud_message(data, topic(type, encoding));
            EXPECT_EQ(message.header.frame, "livox_frame");
            EXPECT_EQ(positions(message.cloud), two_points);
            EXPECT_EQ(column(message.cloud, "offset_time"), (std::vector<double>{1000, 4000}));
            EXPECT_EQ(column(message.cloud, "line"), (std::vector<double>{30, 30}));
        }
        for (std::size_t n = 0; n < data.size(); ++n) {
            EXPECT_THROW(read_cloud_message(std::span(data).first(n),
                                            topic("livox_ros_driver/CustomMsg", encoding)),
                         Malformed);
        }
    }
}

TEST(Transforms, SeveralInOneMessage) {
    for (const MessageEncoding encoding : kEncodings) {
        MessageWriter out(encoding);
        out.number(std::uint32_t{2});
        for (const char* child : {"/base", "lidar"}) {
            if (encoding == MessageEncoding::ros1) out.number(std::uint32_t{0});
            out.number(std::uint32_t{1});
            out.number(std::uint32_t{500'000'000});
            out.text("/map");
            out.text(child);
            for (const double value : {1.0, 2.0, 3.0, 0.0, 0.0, 1.0, 0.0}) out.number(value);
        }
        const auto data = out.moved_bytes();
        const auto read = [&](std::size_t n) {
            return read_as("tf2_msgs/TFMessage", encoding, std::span(data).first(n),
                           read_transforms);
        };
        const auto transforms = read(data.size());
        ASSERT_EQ(transforms.size(), 2U);
        EXPECT_EQ(transforms[0].parent, "map");
        EXPECT_EQ(transforms[0].child, "base");
        EXPECT_EQ(transforms[1].child, "lidar");
        EXPECT_EQ(transforms[1].stamp, 1.5);
        EXPECT_TRUE((transforms[1].T_parent_child * Eigen::Vector3d(1, 0, 0))
                        .isApprox(Eigen::Vector3d(0, 2, 3), 1e-12));
        for (std::size_t n = 0; n < data.size(); ++n) EXPECT_THROW(read(n), Malformed) << n;
    }
}

TEST(PoseMessages, QuaternionsThatAreNoneAreRefused) {
    auto data = pose_message("map", Pose::Identity(), 0.0, MessageEncoding::ros1);
    const double half = 0.5;
    std::memcpy(data.data() + data.size() - sizeof half, &half, sizeof half);
    const auto read = [&] {
        return read_as("geometry_msgs/PoseStamped", MessageEncoding::ros1, data, read_pose_message);
    };
    EXPECT_THROW(read(), Malformed);
    const double nan = std::nan("");
    std::memcpy(data.data() + data.size() - sizeof nan, &nan, sizeof nan);
    EXPECT_FALSE(read().T_parent_child.matrix().allFinite());  // lost, not wrong
}

}  // namespace messages_test
}  // namespace dynamic_filter::io
