// SPDX-License-Identifier: MIT
/// Chooses the poses of a bag's scans among all that the bag says of them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "recording/bag_contents.hpp"

namespace dynamic_filter::io {

/// Poses of the sensor, and how they were chosen.
struct BagPoses {
    /// Of the sensor at a time; empty function: there are none.
    std::function<std::optional<Pose>(double stamp)> T_world_sensor;
    Trajectory trajectory;         ///< all poses that were published
    bool points_in_world = false;  ///< the points are in the frame of the poses
    bool is_linked = false;        ///< the poses are known to be those of the sensor's own frame
    std::vector<std::string> notes{};
};

/// The poses of the frame `sensor` of the clouds, from /tf, or from a topic; ranked by that, then
/// by type, and by how many there are. Where several of the same rank are left, those are taken at
/// which scans overlay best. `wanted`: the topic, or "/tf"; empty: any. Throws ConfigError if the
/// wanted one is not there. The result refers to `contents`.
BagPoses choose_poses(const BagContents& contents, const std::string& sensor,
                      const std::vector<double>& stamps, const std::string& wanted,
                      const std::function<Cloud(std::size_t)>& read);

/// The only frame of `frames` that is named as a LiDAR's; one that has another one of them below it
/// is a housing, and does not count.
std::optional<std::string> only_lidar(const FrameTree& tree, std::vector<std::string> frames);

/// True for the names that drivers give to the frames of their LiDARs.
bool names_lidar(std::string frame);

}  // namespace dynamic_filter::io
