// SPDX-License-Identifier: MIT
/// What is used of ROS messages.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/io/bag.hpp"
#include "dynamic_filter/io/cloud.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

struct MessageHeader {
    double stamp = 0.0;  ///< [s]
    std::string frame;   ///< without a leading slash
};

enum class MessageKind { other, cloud, livox, odometry, pose, transforms };
MessageKind kind_of(const std::string& type);

/// All throw Malformed.
MessageHeader read_header(const Message& message);

struct CloudMessage {
    MessageHeader header;
    Cloud cloud;
};
/// sensor_msgs/PointCloud2 in all its layouts, or Livox's CustomMsg. Padding is left out; what was
/// big endian is no more.
CloudMessage read_cloud_message(std::span<const std::byte> data, const Topic& topic);

/// A frame in another one at a time. `child` is empty where the message does not say.
struct StampedPose {
    double stamp = 0.0;
    std::string parent, child;
    Pose T_parent_child = Pose::Identity();
};
/// nav_msgs/Odometry, geometry_msgs/PoseStamped and PoseWithCovarianceStamped.
StampedPose read_pose_message(const Message& message);
/// tf2_msgs/TFMessage and tf/tfMessage.
std::vector<StampedPose> read_transforms(const Message& message);

}  // namespace dynamic_filter::io
