// SPDX-License-Identifier: MIT
#include "recording/bag_contents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "base/crc.hpp"
#include "formats/byte_reader.hpp"
#include "formats/messages/messages.hpp"
#include "formats/messages/packets.hpp"

namespace dynamic_filter::io {

namespace {

/// Of scans with noise, the last bytes alone tell them apart.
std::uint32_t end_of(std::span<const std::byte> data) {
    constexpr std::size_t kEnd = 4096;
    return crc_of(data.last(std::min(kEnd, data.size())));
}

void add(BagContents& contents, const Message& message) {
    switch (kind_of(message.topic.type)) {
        case MessageKind::cloud:
        case MessageKind::livox: {
            const MessageHeader header = read_header(message);
            CloudTopic& found = contents.clouds[message.topic.name];
            if (found.scans.empty()) found.topic = message.topic;
            found.scans.push_back({header.stamp, message.recorded_ns, message.ref, header.frame,
                                   message.data.size(), end_of(message.data)});
            break;
        }
        case MessageKind::odometry:
        case MessageKind::pose: {
            const PoseMessage pose = read_pose_message(message);
            PoseTopic& found = contents.poses[message.topic.name];
            found.kind = kind_of(message.topic.type);
            found.parent = pose.parent;
            found.child = pose.child;
            if (!pose.T_parent_child.matrix().allFinite()) break;
            found.trajectory.stamps.push_back(pose.stamp);
            found.trajectory.poses.push_back(pose.T_parent_child);
            break;
        }
        case MessageKind::transforms: {
            const bool is_static = message.topic.name.ends_with("tf_static");
            for (const PoseMessage& transform : read_transforms(message)) {
                if (transform.T_parent_child.matrix().allFinite()) {
                    contents.frames.add(transform, is_static);
                }
            }
            break;
        }
        case MessageKind::other:
            if (!driver_of(message.topic.type).empty()) {
                contents.packets.emplace(message.topic.name, message.topic.type);
            }
            if (!advice_on_cloud(message.topic.type).empty()) {
                contents.other_clouds.emplace(message.topic.name, message.topic.type);
            }
            break;
    }
}

bool is_scan(const Topic& topic) { return holds_scan(kind_of(topic.type)); }

}  // namespace

BagContents contents_of(const Bag& bag) {
    BagContents contents;
    std::size_t malformed = 0;
    bool scans = false;  // true if one of the messages is a scan
    std::string first;
    const auto defects = bag.for_each([&](const Message& message) {
        try {
            add(contents, message);
        } catch (const Malformed& error) {
            if (malformed++ == 0) first = message.topic.name + ": " + error.what();
            scans = scans || is_scan(message.topic);
        }
    });
    for (const Defect& defect : defects) {
        (defect.lost ? contents.losses : contents.notes).push_back(defect.what);
    }
    if (malformed > 0) {
        (scans ? contents.losses : contents.notes)
            .push_back(
                fmt::format("{} messages cannot be read and are left out; the first is of {}",
                            malformed, first));
    }
    contents.frames.put_in_order();
    contents.frames.fix_constant_links();
    for (auto& [name, topic] : contents.poses) put_in_order(topic.trajectory);
    return contents;
}

}  // namespace dynamic_filter::io
