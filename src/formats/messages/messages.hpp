// SPDX-License-Identifier: MIT
/// Reads the parts of ROS messages that are used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

struct MessageHeader {
    double stamp = 0.0;         ///< [s]
    std::string frame;          ///< without a leading slash
    std::int64_t stamp_ns = 0;  ///< [ns] the same stamp, exactly
};

enum class MessageKind { other, cloud, livox, odometry, pose, transforms };
MessageKind kind_of(const std::string& type);
/// True for messages with the points of a scan.
inline bool holds_scan(MessageKind kind) {
    return kind == MessageKind::cloud || kind == MessageKind::livox;
}

/// The following functions throw Malformed.
MessageHeader read_header(const Message& message);

struct CloudMessage {
    MessageHeader header;
    Cloud cloud;
};
/// Reads sensor_msgs/PointCloud2 in all its layouts, or CustomMsg of Livox. Padding is left out,
/// and big-endian values are converted.
CloudMessage read_cloud_message(std::span<const std::byte> data, const Topic& topic);

/// Pose of a frame in another frame at a time. `child` is empty if the message does not name it.
struct PoseMessage {
    double stamp = 0.0;
    std::string parent, child;
    Pose T_parent_child = Pose::Identity();
};
/// Reads nav_msgs/Odometry, geometry_msgs/PoseStamped and PoseWithCovarianceStamped.
PoseMessage read_pose_message(const Message& message);
/// Reads tf2_msgs/TFMessage and tf/tfMessage.
std::vector<PoseMessage> read_transforms(const Message& message);

}  // namespace dynamic_filter::io
