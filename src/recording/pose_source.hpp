// SPDX-License-Identifier: MIT
/// Poses of a sensor over time, from /tf or from a topic with poses.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/poses.hpp"
#include "recording/frame_tree.hpp"

namespace dynamic_filter::io {

/// The poses of a topic: of the frame `child` (empty: not named) in the frame `parent`.
struct PoseTopic {
    std::string parent, child;
    Trajectory trajectory;
    MessageKind kind = MessageKind::odometry;
};

/// Poses of a sensor in its world frame.
struct PoseSource {
    std::function<std::optional<Pose>(double stamp)> T_world_sensor;
    std::vector<double> stamps;    ///< [s] at which poses were published
    bool points_in_world = false;  ///< the frame of the points is the world frame
    std::string world;             ///< name of the world frame
    std::string note;              ///< one sentence for the user
    bool is_linked = true;         ///< false: assumed to be those of the sensor, without a link
};

/// All poses that were published.
Trajectory trajectory_of(const PoseSource& source);

/// Poses from /tf: of the frame `sensor` in the frame `world` (empty: its root). The result refers
/// to `frames`.
PoseSource from_frames(const FrameTree& frames, const std::string& sensor,
                       const std::string& world = {}, const LinkLookup& lookup = {});

/// Poses of the topic `name`. If /tf links its frame to the frame `sensor`, that transform is
/// applied. The result refers to `topic` and `frames`.
PoseSource from_topic(const std::string& name, const PoseTopic& topic, const FrameTree& frames,
                      const std::string& sensor, const LinkLookup& lookup = {});

}  // namespace dynamic_filter::io
