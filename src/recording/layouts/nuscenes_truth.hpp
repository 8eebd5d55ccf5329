// SPDX-License-Identifier: MIT
/// Ground truth of nuScenes: which points lie in the box of an object that moves. The classes of
/// its label files (lidarseg) do not tell this, because a parked car has that of a driven one.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io::nuscenes {

/// The box of an object that moves.
struct MovingBox {
    Pose T_box_world = Pose::Identity();             ///< the box's axes, from its centre
    Eigen::Vector3d half = Eigen::Vector3d::Zero();  ///< [m] half the edges along its axes
};

/// The table of boxes.
std::filesystem::path annotations_of(const std::filesystem::path& tables);

/// Boxes of moving objects at the samples of these tokens. An object moves if an attribute says so
/// at one of them; it then counts as moving at all, as in SemanticKITTI. Empty if the samples have
/// no annotations at all, as in the split for tests; otherwise, each sample has an entry. Throws
/// InputError.
std::map<std::string, std::vector<MovingBox>> moving_boxes(const std::filesystem::path& tables,
                                                           const std::set<std::string>& samples);

/// One label per point: dynamic in the boxes, static elsewhere.
Labels truth_by(const std::vector<MovingBox>& boxes, const Points& points,
                const Pose& T_world_sensor);

}  // namespace dynamic_filter::io::nuscenes
