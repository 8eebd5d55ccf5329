// SPDX-License-Identifier: MIT
/// The boxes that people drew around what they saw in the drives of KITTI's raw data, and the
/// ground truth that follows from them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::app {

/// A thing that was followed through scans without a gap.
struct Tracklet {
    std::string type;                  ///< "Car"
    Eigen::Vector3d size;              ///< [m] length, width, height
    std::size_t first_scan = 0;        ///< number of the scan
    std::vector<Pose> T_sensor_box{};  ///< by scan; the origin of a box is the middle of its bottom
};

/// Reads tracklet_labels.xml. Throws InputError.
std::vector<Tracklet> read_tracklets(const std::filesystem::path& file);

/// What the track tells: moving if two of its middles are more than 1.5 m apart in the world,
/// resting if none are more than 0.75 m apart, else unknown. `T_world_sensor`: by scan number.
Label motion_of(const Tracklet& track, const std::vector<Pose>& T_world_sensor);

/// What is known of the points of a scan. Unknown are those nearer than 3 m or farther than 60 m
/// from the sensor's axis, those that the front camera does not see (more than 40 degrees from
/// ahead), where nobody drew boxes, and, of a box that moves, what lies within 0.2 m around it or
/// in its lowest 0.2 m. What else is in such a box is dynamic; all other points are static.
/// `motions`: of the tracks, parallel.
Labels truth_by_tracklets(const std::vector<Tracklet>& tracks, const Labels& motions,
                          std::size_t scan, const Points& points);

}  // namespace dynamic_filter::app
