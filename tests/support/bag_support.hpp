// SPDX-License-Identifier: MIT
/// Bags and messages for the tests of bags.
#pragma once

#include <cmath>
#include <cstring>
#include <limits>

#include "dynamic_filter/bag.hpp"
#include "formats/bags/bag_writers.hpp"
#include "formats/byte_writer.hpp"
#include "support/bytes.hpp"
#include "support/random.hpp"

namespace dynamic_filter::io {

/// A message on its own.
struct WrittenMessage {
    Topic topic;
    std::int64_t time_ns = 0;
    std::vector<std::byte> data;
    bool operator==(const WrittenMessage&) const = default;
};

struct ReadBack {
    std::vector<WrittenMessage> messages;
    std::vector<std::string> notes;
    bool lost = false;  ///< by what the notes say
};

/// All messages; each must be the same when it is read again on its own.
inline ReadBack read_all(const std::filesystem::path& path) {
    const Bag bag(path);
    ReadBack back;
    std::vector<MessageRef> refs;
    const auto defects = bag.for_each([&](const Message& m) {
        back.messages.push_back({m.topic, m.recorded_ns, {m.data.begin(), m.data.end()}});
        refs.push_back(m.ref);
    });
    for (const Defect& defect : defects) {
        back.notes.push_back(defect.what);
        back.lost = back.lost || defect.lost;
    }
    for (std::size_t i = 0; i < refs.size(); ++i) {
        EXPECT_EQ(bag.read(refs[i]), back.messages[i].data);
    }
    return back;
}

inline void write_bag(const std::filesystem::path& path,
                      const std::vector<WrittenMessage>& messages) {
    const auto writer = BagWriter::create(path);
    for (const WrittenMessage& m : messages) writer->write(m.topic, m.time_ns, m.data);
    writer->commit();
}

inline MessageEncoding encoding_of(const std::string& extension) {
    return extension == ".bag" ? MessageEncoding::ros1 : MessageEncoding::cdr;
}

/// x, y, z and one field of each type, some with several values.
inline Cloud cloud_of_all_types(std::size_t points, test::Random& random) {
    Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, FieldType::f32);
    add_field(cloud, "a", FieldType::i8);
    add_field(cloud, "b", FieldType::u8, 3);
    add_field(cloud, "c", FieldType::i16);
    add_field(cloud, "d", FieldType::u16, 2);
    add_field(cloud, "e", FieldType::i32);
    add_field(cloud, "f", FieldType::u32);
    add_field(cloud, "g", FieldType::i64);
    add_field(cloud, "h", FieldType::u64, 2);
    add_field(cloud, "i", FieldType::f32, 2);
    add_field(cloud, "j", FieldType::f64);
    cloud.data.resize(points * cloud.point_bytes);
    for (std::byte& byte : cloud.data) byte = static_cast<std::byte>(random.below(256));
    return cloud;
}

/// Small clouds and poses on several topics, one cloud of them empty.
inline std::vector<WrittenMessage> some_messages(MessageEncoding encoding, std::size_t rounds,
                                                 std::size_t points) {
    test::Random random(1);
    std::vector<WrittenMessage> messages;
    for (std::size_t i = 0; i < rounds; ++i) {
        const double stamp = 1.6e9 + 0.1 * static_cast<double>(i);
        const Cloud cloud = cloud_of_all_types(i == 1 ? 0 : points, random);
        const Pose pose = random.pose(50.0, 3.0);
        const auto add = [&](const char* name, const char* type, std::vector<std::byte> data) {
            messages.push_back({{name, type, encoding},
                                to_nanoseconds(stamp) + static_cast<std::int64_t>(messages.size()),
                                std::move(data)});
        };
        add("/points", "sensor_msgs/PointCloud2", cloud_message(cloud, stamp, "lidar", encoding));
        add("/tf", "tf2_msgs/TFMessage", transform_message("map", "base", pose, stamp, encoding));
        add("/rear/points", "sensor_msgs/PointCloud2",
            cloud_message(cloud, stamp, "rear", encoding));
        add("/odom", "nav_msgs/Odometry", odometry_message("odom", "base", pose, stamp, encoding));
        add("/pose", "geometry_msgs/PoseStamped", pose_message("map", pose, stamp, encoding));
        if (i > 0) continue;
        add("/tf_static", "tf2_msgs/TFMessage",
            transform_message("base", "lidar", pose, stamp, encoding));
    }
    return messages;
}

}  // namespace dynamic_filter::io
