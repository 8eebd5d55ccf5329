// SPDX-License-Identifier: MIT
/// What a recording is made of.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::io {

/// Makes the ground truth of scan i for the points of its cloud. Throws InputError.
using TruthReader = std::function<Labels(std::size_t i, const Cloud& cloud)>;

/// One of several sensors that move together.
struct RigSensor {
    std::string name{};       ///< before the names of its scans; may be empty
    Trajectory trajectory{};  ///< T_world_sensor; empty without poses
    /// Where it is on the vehicle; empty: not known.
    std::optional<Pose> T_vehicle_sensor{};
    double clock = 0.0;                 ///< [s] that was added to its stamps
    std::filesystem::path recording{};  ///< of a rig file
};

struct RecordingParts {
    Info info;
    /// Reads the cloud of scan i. Throws InputError.
    std::function<Cloud(std::size_t)> read_cloud;
    /// Throws InputError if the size of a scan's file alone shows that it is damaged; empty for
    /// scans that are no files.
    std::function<void(const std::filesystem::path&)> refuse_bad_size{};
    /// For scans whose ground truth is not in a file of labels; or empty.
    TruthReader read_truth{};
    bool with_times = false;  ///< scans have the times of their points
    /// Of the sensor, parallel to the scans, or empty: the motion within scans that have times is
    /// undone with them.
    std::vector<Twist> velocities{};
    /// Parallel to the scans: which sensor of `rig` made it; or empty. Each sensor has its own
    /// poses, with which the motion within its scans is undone.
    std::vector<std::size_t> sensors{};
    std::vector<RigSensor> rig{};
};

/// See stem().
std::string name_of_scan(const RecordingParts& parts, std::size_t i);

/// FullScan::sensor of scan i, without reading it.
std::size_t sensor_of(const Recording& recording, std::size_t i);

/// The scans of each sensor, as recordings of their own; the recording itself if it has one.
std::vector<Recording> by_sensor(const Recording& recording);

/// The folder or file that was opened, those of the scans, and of a rig those of its sensors.
std::vector<std::filesystem::path> folders_of(const Recording& recording);

/// Throws ConfigError if the selection can have no scan, whatever the recording.
void check_selection(std::size_t first, std::optional<std::size_t> last, std::size_t stride);

/// Keeps the selected scans. Throws ConfigError if there are none.
void select(RecordingParts& parts, std::size_t first, std::optional<std::size_t> last,
            std::size_t stride);

/// The scans of these indices, in this order.
Recording chosen_scans(const Recording& recording, const std::vector<std::size_t>& indices);

/// Points as a file has them, in metres.
Points in_metres(Points points, const Info& info);

/// Transforms the points of a cloud in world coordinates into the sensor frame; in double, because
/// the world may be far from its origin. `unit`: [m] per unit of the coordinates.
Points into_sensor(const Cloud& cloud, double unit, const Pose& T_world_sensor);

/// Points of the frame in which the sensor is at `at` [m], moved into the sensor frame. Those at
/// the sensor itself are no returns, which were (0, 0, 0) before they were moved into the other
/// frame; they are so again.
Points seen_from(const Eigen::Vector3d& at, Points points);

/// True if the pose is farther away than the circumference of the Earth; such a value is a wrong
/// number or has a wrong unit.
bool is_absurdly_far(const Pose& T_world_sensor);

}  // namespace dynamic_filter::io
