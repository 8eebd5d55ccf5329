// SPDX-License-Identifier: MIT
#include "dynamic_filter/bag.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "dynamic_filter/error.hpp"
#include "formats/messages/message_writer.hpp"
#include "formats/time_units.hpp"

namespace dynamic_filter::io {
namespace {

void put_time(MessageWriter& out, double stamp) {
    const std::int64_t time = to_nanoseconds(stamp);
    out.number(static_cast<std::uint32_t>(time / kSecond));
    out.number(static_cast<std::uint32_t>(time % kSecond));
}

void put_header(MessageWriter& out, double stamp, const std::string& frame) {
    if (!out.is_cdr()) out.number(std::uint32_t{0});  // seq
    put_time(out, stamp);
    out.text(frame);
}

void put_pose(MessageWriter& out, const Pose& pose) {
    const Eigen::Quaterniond rotation(pose.linear());
    for (const double value : pose.translation()) out.number(value);
    for (const double value : rotation.coeffs()) out.number(value);  // x y z w
}

/// Writes `count` zeros.
void put_zeros(MessageWriter& out, int count) {
    for (int i = 0; i < count; ++i) out.number(0.0);
}

constexpr int kCovariance = 36;

/// Codes of sensor_msgs/PointField: INT8 = 1 ... FLOAT64 = 8.
std::uint8_t wire_type(FieldType type) {
    switch (type) {
        case FieldType::i8:
            return 1;
        case FieldType::u8:
            return 2;
        case FieldType::i16:
            return 3;
        case FieldType::u16:
            return 4;
        case FieldType::i32:
            return 5;
        case FieldType::u32:
            return 6;
        case FieldType::f32:
            return 7;
        case FieldType::i64:
        case FieldType::u64:
        case FieldType::f64:
            break;
    }
    return 8;
}

template <class T>
void to_float64(std::byte* value) {
    T integer{};
    std::memcpy(&integer, value, sizeof integer);
    const auto wide = static_cast<double>(integer);
    std::memcpy(value, &wide, sizeof wide);
}

std::vector<std::byte> without_wide_integers(const Cloud& cloud) {
    std::vector<std::byte> data = cloud.data;
    for (const Field& field : cloud.fields) {
        if (field.type != FieldType::i64 && field.type != FieldType::u64) continue;
        const auto convert =
            field.type == FieldType::i64 ? to_float64<std::int64_t> : to_float64<std::uint64_t>;
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            std::byte* value = data.data() + i * cloud.point_bytes + field.offset;
            for (std::uint32_t k = 0; k < field.count; ++k) convert(value + k * sizeof(double));
        }
    }
    return data;
}

bool is_dense(const Cloud& cloud) {
    const Points points = positions(cloud);
    return std::all_of(points.begin(), points.end(),
                       [](const Point& point) { return point.allFinite(); });
}

}  // namespace

std::int64_t to_nanoseconds(double stamp) {
    constexpr double kEnd = 2147483647.0;  // int32 in ROS 2; rounding may add a second
    if (!(stamp >= 0.0 && stamp < kEnd)) {
        throw Error("a stamp of " + std::to_string(stamp) + " s does not fit a ROS message");
    }
    // Separately, because a double cannot hold the digits of both.
    const double whole = std::floor(stamp);
    return static_cast<std::int64_t>(whole) * kSecond + std::llround((stamp - whole) * 1e9);
}

std::vector<std::byte> cloud_message(const Cloud& cloud, double stamp, const std::string& frame,
                                     MessageEncoding encoding) {
    if (cloud.data.size() > std::numeric_limits<std::uint32_t>::max()) {
        throw Error("a cloud of " + std::to_string(cloud.data.size()) +
                    " bytes does not fit a ROS message of 4 GiB");
    }
    const auto point_step = static_cast<std::uint32_t>(cloud.point_bytes);
    const auto width = static_cast<std::uint32_t>(cloud.size());
    MessageWriter out(encoding);
    put_header(out, stamp, frame);
    out.number(std::uint32_t{1});  // height
    out.number(width);
    out.number(static_cast<std::uint32_t>(cloud.fields.size()));
    for (const Field& field : cloud.fields) {
        out.text(field.name);
        out.number(field.offset);
        out.number(wire_type(field.type));
        out.number(field.count);
    }
    out.number(std::uint8_t{0});  // is_bigendian: no
    out.number(point_step);
    out.number(point_step * width);
    out.bytes(without_wide_integers(cloud));
    out.number(static_cast<std::uint8_t>(is_dense(cloud) ? 1 : 0));
    return out.moved_bytes();
}

std::vector<std::byte> transform_message(const std::string& parent, const std::string& child,
                                         const Pose& T_parent_child, double stamp,
                                         MessageEncoding encoding) {
    MessageWriter out(encoding);
    out.number(std::uint32_t{1});  // number of transforms
    put_header(out, stamp, parent);
    out.text(child);
    put_pose(out, T_parent_child);
    return out.moved_bytes();
}

std::vector<std::byte> odometry_message(const std::string& parent, const std::string& child,
                                        const Pose& T_parent_child, double stamp,
                                        MessageEncoding encoding) {
    constexpr int kTwist = 6;
    MessageWriter out(encoding);
    put_header(out, stamp, parent);
    out.text(child);
    put_pose(out, T_parent_child);
    put_zeros(out, kCovariance + kTwist + kCovariance);
    return out.moved_bytes();
}

std::vector<std::byte> pose_message(const std::string& frame, const Pose& pose, double stamp,
                                    MessageEncoding encoding) {
    MessageWriter out(encoding);
    put_header(out, stamp, frame);
    put_pose(out, pose);
    return out.moved_bytes();
}

std::vector<std::byte> path_message(const std::string& frame, const std::vector<double>& stamps,
                                    const std::vector<Pose>& poses, MessageEncoding encoding) {
    MessageWriter out(encoding);
    put_header(out, stamps.empty() ? 0.0 : stamps.back(), frame);
    out.number(static_cast<std::uint32_t>(poses.size()));
    for (std::size_t i = 0; i < poses.size(); ++i) {
        put_header(out, stamps[i], frame);
        put_pose(out, poses[i]);
    }
    return out.moved_bytes();
}

std::vector<std::byte> occupancy_message(const OccupancyCells& cells, double stamp,
                                         const std::string& frame, MessageEncoding encoding) {
    MessageWriter out(encoding);
    put_header(out, stamp, frame);
    put_time(out, stamp);
    out.number(static_cast<float>(cells.cell));
    out.number(cells.width);
    out.number(cells.height);
    put_pose(out, Pose(Eigen::Translation3d(cells.origin)));
    out.bytes(std::as_bytes(std::span(cells.values)));
    return out.moved_bytes();
}

namespace {

/// One visualization_msgs/Marker: a red box, or the order to delete all markers.
void put_marker(MessageWriter& out, const std::optional<BoxMarker>& box, std::int32_t id,
                double stamp, const std::string& frame) {
    constexpr std::int32_t kCube = 1, kAdd = 0, kDeleteAll = 3;
    const BoxMarker shown = box.value_or(BoxMarker{});
    put_header(out, stamp, frame);
    out.text("removed");
    out.number(id);
    out.number(kCube);
    out.number(box ? kAdd : kDeleteAll);
    put_pose(out, Pose(Eigen::Translation3d(shown.center)));
    for (const double value : shown.size) out.number(value);
    for (const float value : {0.9F, 0.1F, 0.1F, 0.5F}) out.number(value);  // red, half transparent
    out.number(std::int32_t{1});                                           // lifetime: 1 s
    out.number(std::uint32_t{0});
    out.number(std::uint8_t{0});   // not locked to its frame
    out.number(std::uint32_t{0});  // no points
    out.number(std::uint32_t{0});  // no colors
    if (out.is_cdr()) {            // texture_resource, texture, uv_coordinates
        out.text("");
        put_header(out, 0.0, "");
        out.text("");
        out.number(std::uint32_t{0});
        out.number(std::uint32_t{0});
    }
    out.text("");  // text
    out.text("");  // mesh_resource
    if (out.is_cdr()) {
        out.text("");  // mesh_file
        out.number(std::uint32_t{0});
    }
    out.number(std::uint8_t{0});  // mesh_use_embedded_materials
}

}  // namespace

std::vector<std::byte> boxes_message(const std::vector<BoxMarker>& boxes, double stamp,
                                     const std::string& frame, MessageEncoding encoding) {
    MessageWriter out(encoding);
    out.number(static_cast<std::uint32_t>(boxes.size() + 1));
    put_marker(out, std::nullopt, 0, stamp, frame);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        put_marker(out, boxes[i], static_cast<std::int32_t>(i + 1), stamp, frame);
    }
    return out.moved_bytes();
}

std::vector<std::byte> diagnostics_message(const std::vector<DiagnosticStatus>& statuses,
                                           double stamp, MessageEncoding encoding) {
    MessageWriter out(encoding);
    put_header(out, stamp, "");
    out.number(static_cast<std::uint32_t>(statuses.size()));
    for (const DiagnosticStatus& status : statuses) {
        out.number(status.level);
        out.text(status.name);
        out.text(status.message);
        out.text(status.hardware);
        out.number(static_cast<std::uint32_t>(status.values.size()));
        for (const auto& [key, value] : status.values) {
            out.text(key);
            out.text(value);
        }
    }
    return out.moved_bytes();
}

}  // namespace dynamic_filter::io
