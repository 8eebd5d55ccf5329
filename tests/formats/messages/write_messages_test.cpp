// SPDX-License-Identifier: MIT
#include "dynamic_filter/bag.hpp"

#include "formats/byte_reader.hpp"
#include "formats/messages/definitions.hpp"
#include "formats/messages/message_writer.hpp"
#include "formats/messages/messages.hpp"
#include "support/bag_support.hpp"

namespace dynamic_filter::io {
namespace write_messages_test {

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

TEST(WriteMessages, CloudsKeepAllFields) {
    test::Random random(7);
    for (const MessageEncoding encoding : kEncodings) {
        for (const std::size_t points : {0U, 1U, 100U}) {
            const Cloud cloud = cloud_of_all_types(points, random);
            const auto data = cloud_message(cloud, 1234567890.123456, "front/lidar", encoding);
            const CloudMessage back = read_cloud(data, encoding);
            EXPECT_EQ(back.header.frame, "front/lidar");
            EXPECT_DOUBLE_EQ(back.header.stamp, 1234567890.123456);
            ASSERT_EQ(back.cloud.fields.size(), cloud.fields.size());
            EXPECT_EQ(back.cloud.point_bytes, cloud.point_bytes);
            for (std::size_t f = 0; f < cloud.fields.size(); ++f) {
                const Field& field = cloud.fields[f];
                const Field& got = back.cloud.fields[f];
                const bool wide = field.type == FieldType::i64 || field.type == FieldType::u64;
                EXPECT_EQ(got.type, wide ? FieldType::f64 : field.type);
                EXPECT_EQ(got.count, field.count);
                EXPECT_EQ(got.offset, field.offset);
                for (std::size_t i = 0; i < points; ++i) {
                    const std::size_t at = i * cloud.point_bytes + field.offset;
                    const std::size_t size = size_of(field.type) * field.count;
                    if (wide) continue;
                    EXPECT_EQ(std::memcmp(&cloud.data[at], &back.cloud.data[at], size), 0);
                }
                if (wide) {
                    EXPECT_EQ(values(back.cloud, got), values(cloud, field));
                }
            }
        }
    }
}

TEST(WriteMessages, SayIfAllPointsAreFinite) {
    Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, FieldType::f32);
    cloud.data.resize(12);
    const auto dense = [&] { return cloud_message(cloud, 0.0, "", MessageEncoding::ros1).back(); };
    EXPECT_EQ(dense(), std::byte{1});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(&cloud.data[8], &nan, sizeof nan);
    EXPECT_EQ(dense(), std::byte{0});
}

TEST(WriteMessages, PosesComeBack) {
    test::Random random(3);
    for (const MessageEncoding encoding : kEncodings) {
        for (int i = 0; i < 100; ++i) {
            const Pose pose = random.pose(1000.0, 3.1);
            const double stamp = random.uniform(0.0, 2e9);
            const auto check = [&](const PoseMessage& back, const char* child) {
                EXPECT_NEAR(back.stamp, stamp, 1e-9 + 1e-16 * stamp);
                EXPECT_EQ(back.parent, "map");
                EXPECT_EQ(back.child, child);
                EXPECT_TRUE(back.T_parent_child.isApprox(pose, 1e-12));
            };
            check(
                read_as("nav_msgs/Odometry", encoding,
                        odometry_message("map", "base", pose, stamp, encoding), read_pose_message),
                "base");
            check(read_as("geometry_msgs/PoseStamped", encoding,
                          pose_message("map", pose, stamp, encoding), read_pose_message),
                  "");
            const auto transforms =
                read_as("tf2_msgs/TFMessage", encoding,
                        transform_message("map", "base", pose, stamp, encoding), read_transforms);
            ASSERT_EQ(transforms.size(), 1U);
            check(transforms.front(), "base");
        }
    }
}

TEST(WriteMessages, StampsAreRounded) {
    EXPECT_EQ(to_nanoseconds(0.0), 0);
    EXPECT_EQ(to_nanoseconds(0.1), 100'000'000);
    EXPECT_EQ(to_nanoseconds(1.9999999999), 2'000'000'000);
    EXPECT_EQ(to_nanoseconds(1600000000.5), 1'600'000'000'500'000'000);
    EXPECT_EQ(to_nanoseconds(1600000000.25), 1'600'000'000'250'000'000);
    for (const double stamp : {-1e-9, 2147483647.0, std::nan("")}) {
        EXPECT_THROW(to_nanoseconds(stamp), Error);
    }
}

}  // namespace write_messages_test
}  // namespace dynamic_filter::io
