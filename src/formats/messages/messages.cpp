// SPDX-License-Identifier: MIT
#include "formats/messages/messages.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "formats/clouds/records.hpp"
#include "formats/messages/message_reader.hpp"
#include "formats/time_units.hpp"

namespace dynamic_filter::io {
namespace {

MessageHeader read_header(MessageReader& in, MessageEncoding encoding) {
    if (encoding == MessageEncoding::ros1) in.number<std::uint32_t>();  // seq
    const std::int64_t seconds = encoding == MessageEncoding::ros1
                                     ? std::int64_t{in.number<std::uint32_t>()}
                                     : std::int64_t{in.number<std::int32_t>()};
    const auto nanoseconds = in.number<std::uint32_t>();
    std::string frame = in.text();
    if (frame.starts_with('/')) frame.erase(0, 1);  // names before tf2 begin with a slash
    return {static_cast<double>(seconds) + 1e-9 * nanoseconds, std::move(frame),
            seconds * kSecond + nanoseconds};
}

Pose read_pose(MessageReader& in) {
    std::array<double, 7> v{};
    for (double& value : v) value = in.number<double>();
    const Eigen::Quaterniond rotation(v[6], v[3], v[4], v[5]);
    constexpr double kTolerance = 0.01;  // the same as for pose files
    const bool finite = rotation.coeffs().allFinite();
    if (finite && std::abs(rotation.norm() - 1.0) > kTolerance) {
        throw Malformed("its quaternion has length " + std::to_string(rotation.norm()) +
                        "; expected 1");
    }
    Pose pose = Pose::Identity();
    pose.linear() = rotation.normalized().toRotationMatrix();
    pose.translation() << v[0], v[1], v[2];
    return pose;
}

struct WireField {
    std::string name;
    std::uint32_t offset = 0, count = 1;
    std::uint8_t type = 0;
};

/// Converts the codes of sensor_msgs/PointField: INT8 = 1 ... FLOAT64 = 8.
FieldType field_type(const WireField& field) {
    constexpr std::array kTypes = {FieldType::i8,  FieldType::u8,  FieldType::i16, FieldType::u16,
                                   FieldType::i32, FieldType::u32, FieldType::f32, FieldType::f64};
    if (field.type < 1 || field.type > kTypes.size()) {
        throw Malformed("its field '" + field.name + "' has the unknown type " +
                        std::to_string(field.type));
    }
    return kTypes[field.type - 1U];
}

struct WireCloud {
    std::uint32_t height = 0, width = 0, point_step = 0, row_step = 0;
    bool big_endian = false;
    std::vector<WireField> fields;
    std::span<const std::byte> data;
};

WireCloud read_wire_cloud(MessageReader& in) {
    WireCloud wire;
    wire.height = in.number<std::uint32_t>();
    wire.width = in.number<std::uint32_t>();
    constexpr std::size_t kLeastField = 13;
    for (auto left = in.count(kLeastField); left > 0; --left) {
        WireField field;
        field.name = in.text();
        field.offset = in.number<std::uint32_t>();
        field.type = in.number<std::uint8_t>();
        field.count = in.number<std::uint32_t>();
        wire.fields.push_back(std::move(field));
    }
    wire.big_endian = in.number<std::uint8_t>() != 0;
    wire.point_step = in.number<std::uint32_t>();
    wire.row_step = in.number<std::uint32_t>();
    wire.data = in.bytes();
    return wire;
}

/// Corrects fields of faulty writers: a missing row_step, or 0 for a count of 1.
void repair(WireCloud& wire) {
    if (wire.row_step == 0) wire.row_step = wire.point_step * wire.width;
    for (WireField& field : wire.fields) field.count = std::max(field.count, 1U);
}

void check(const WireCloud& wire) {
    const auto number = [](std::uint64_t n) { return std::to_string(n); };
    std::uint64_t field_bytes = 0;
    for (const WireField& field : wire.fields) {
        const std::uint64_t bytes = std::uint64_t{field.count} * size_of(field_type(field));
        if (field.offset + bytes > wire.point_step) {
            throw Malformed("its field '" + field.name + "' ends at byte " +
                            number(field.offset + bytes) + " of points of " +
                            number(wire.point_step));
        }
        field_bytes += bytes;
    }
    // Several fields may share the same bytes, but their number is limited.
    constexpr std::uint64_t kMostNames = 8;
    if (field_bytes > kMostNames * wire.point_step) {
        throw Malformed("its fields overlap: they have " + number(field_bytes) +
                        " bytes together, in points of " + number(wire.point_step));
    }
    const std::uint64_t row = std::uint64_t{wire.point_step} * wire.width;
    if (wire.height > 1 && wire.row_step < row) {
        throw Malformed("its rows have " + number(wire.row_step) + " bytes; " + number(wire.width) +
                        " points of " + number(wire.point_step) + " need " + number(row));
    }
    const std::uint64_t needed = wire.height == 0 || wire.width == 0
                                     ? 0
                                     : std::uint64_t{wire.row_step} * (wire.height - 1U) + row;
    if (needed > wire.data.size()) {
        throw Malformed("its " + number(wire.width) + " x " + number(wire.height) +
                        " points need " + number(needed) + " bytes, but it holds " +
                        number(wire.data.size()));
    }
    if (wire.point_step == 0 && needed == 0 && std::uint64_t{wire.width} * wire.height > 0) {
        throw Malformed("its points have no bytes");
    }
}

/// Makes names unique by adding a number; fields with an empty name or "_" are padding.
std::vector<WireField> named_fields(const WireCloud& wire) {
    std::vector<WireField> fields;
    std::set<std::string> taken;
    for (const WireField& field : wire.fields) taken.insert(field.name);
    std::map<std::string, int> seen;
    for (WireField field : wire.fields) {
        if (field.name.empty() || field.name == "_") continue;
        const std::string given = field.name;
        for (int& count = ++seen[given]; count > 1; ++count) {
            field.name = given + "_" + std::to_string(count);
            if (taken.insert(field.name).second) break;
        }
        fields.push_back(std::move(field));
    }
    return fields;
}

/// Bytes of a point that are copied together.
struct Run {
    std::size_t offset = 0, bytes = 0;
};

std::vector<Run> runs_of(const std::vector<WireField>& fields) {
    std::vector<Run> runs;
    for (const WireField& field : fields) {
        const std::size_t bytes = field.count * size_of(field_type(field));
        const bool follows =
            !runs.empty() && runs.back().offset + runs.back().bytes == field.offset;
        if (follows) {
            runs.back().bytes += bytes;
        } else {
            runs.push_back({field.offset, bytes});
        }
    }
    return runs;
}

/// Returns where the next point goes.
std::byte* copy_swapped(std::byte* to, const std::byte* from,
                        const std::vector<WireField>& fields) {
    for (const WireField& field : fields) {
        const std::size_t size = size_of(field_type(field));
        const std::byte* value = from + field.offset;
        for (std::uint32_t k = 0; k < field.count; ++k, to += size, value += size) {
            std::reverse_copy(value, value + size, to);
        }
    }
    return to;
}

Cloud unpack_cloud(const WireCloud& wire) {
    const std::vector<WireField> fields = named_fields(wire);
    Cloud cloud;
    for (const WireField& field : fields) {
        add_field(cloud, field.name, field_type(field), field.count);
    }
    for (const char* axis : {"x", "y", "z"}) {
        const Field* field = cloud.find(axis);
        if (field == nullptr) throw Malformed(std::string("has no field '") + axis + "'");
        if (field->type != FieldType::f32 && field->type != FieldType::f64) {
            throw Malformed(std::string("its field '") + axis + "' is not float32 or float64");
        }
    }
    cloud.data.resize(cloud.point_bytes * wire.width * wire.height);
    std::byte* to = cloud.data.data();
    // A claim of 4 billion empty rows means no rows.
    const std::uint32_t rows = wire.width == 0 ? 0 : wire.height;
    const std::vector<Run> runs = runs_of(fields);
    const bool is_packed = !wire.big_endian && runs.size() == 1 && runs[0].bytes == wire.point_step;
    for (std::uint32_t row = 0; row < rows; ++row) {
        const std::byte* from = wire.data.data() + std::size_t{wire.row_step} * row;
        if (is_packed) {
            const std::size_t bytes = std::size_t{wire.point_step} * wire.width;
            to = std::copy_n(from, bytes, to);
            continue;
        }
        for (std::uint32_t i = 0; i < wire.width; ++i, from += wire.point_step) {
            if (wire.big_endian) {
                to = copy_swapped(to, from, fields);
                continue;
            }
            for (const Run& run : runs) to = std::copy_n(from + run.offset, run.bytes, to);
        }
    }
    return cloud;
}

/// Reads livox_ros_driver/CustomMsg; offset_time [ns] is relative to the stamp.
Cloud read_livox(MessageReader& in) {
    in.number<std::uint64_t>();  // timebase
    in.number<std::uint32_t>();  // number of points, repeated
    for (int i = 0; i < 4; ++i) in.number<std::uint8_t>();
    Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, FieldType::f32);
    add_field(cloud, "offset_time", FieldType::u32);
    for (const char* name : {"reflectivity", "tag", "line"}) add_field(cloud, name, FieldType::u8);
    constexpr std::size_t kLeastPoint = 19;
    const auto count = in.count(kLeastPoint);
    cloud.data.resize(cloud.point_bytes * count);
    std::byte* to = cloud.data.data();
    const auto put = [&](auto value) {
        std::memcpy(to, &value, sizeof value);
        to += sizeof value;
    };
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto offset_time = in.number<std::uint32_t>();
        for (int axis = 0; axis < 3; ++axis) put(in.number<float>());
        put(offset_time);
        for (int k = 0; k < 3; ++k) put(in.number<std::uint8_t>());
    }
    return cloud;
}

}  // namespace

MessageKind kind_of(const std::string& type) {
    static const std::map<std::string, MessageKind> kinds = {
        {"sensor_msgs/PointCloud2", MessageKind::cloud},
        {"livox_ros_driver/CustomMsg", MessageKind::livox},
        {"livox_ros_driver2/CustomMsg", MessageKind::livox},
        {"livox_interfaces/CustomMsg", MessageKind::livox},
        {"nav_msgs/Odometry", MessageKind::odometry},
        {"geometry_msgs/PoseStamped", MessageKind::pose},
        {"geometry_msgs/PoseWithCovarianceStamped", MessageKind::pose},
        {"tf2_msgs/TFMessage", MessageKind::transforms},
        {"tf/tfMessage", MessageKind::transforms},
    };
    const auto found = kinds.find(type);
    return found == kinds.end() ? MessageKind::other : found->second;
}

MessageHeader read_header(const Message& message) {
    MessageReader in(message.data, message.topic.encoding);
    return read_header(in, message.topic.encoding);
}

CloudMessage read_cloud_message(std::span<const std::byte> data, const Topic& topic) {
    MessageReader in(data, topic.encoding);
    CloudMessage message{read_header(in, topic.encoding), {}};
    if (kind_of(topic.type) == MessageKind::livox) {
        message.cloud = read_livox(in);
        return message;
    }
    WireCloud wire = read_wire_cloud(in);
    repair(wire);
    check(wire);
    message.cloud = unpack_cloud(wire);
    return message;
}

PoseMessage read_pose_message(const Message& message) {
    MessageReader in(message.data, message.topic.encoding);
    MessageHeader header = read_header(in, message.topic.encoding);
    const bool has_child = kind_of(message.topic.type) == MessageKind::odometry;
    PoseMessage pose{header.stamp, std::move(header.frame), {}, {}};
    if (has_child) pose.child = in.text();
    if (pose.child.starts_with('/')) pose.child.erase(0, 1);
    pose.T_parent_child = read_pose(in);
    return pose;
}

std::vector<PoseMessage> read_transforms(const Message& message) {
    MessageReader in(message.data, message.topic.encoding);
    constexpr std::size_t kLeastTransform = 72;
    std::vector<PoseMessage> transforms;
    for (auto left = in.count(kLeastTransform); left > 0; --left) {
        MessageHeader header = read_header(in, message.topic.encoding);
        std::string child = in.text();
        if (child.starts_with('/')) child.erase(0, 1);
        transforms.push_back(
            {header.stamp, std::move(header.frame), std::move(child), read_pose(in)});
    }
    return transforms;
}

}  // namespace dynamic_filter::io
