// SPDX-License-Identifier: MIT
/// @file
/// Basic types of all modules.
///
/// - Units: lengths in metres, angles in radians unless a name ends in `_deg`, times in seconds.
/// - Frames: *sensor* (of one scan), *world* (of the poses), *map* (world, shifted to a nearby
///   origin so that floats are precise enough). `T_a_b` maps coordinates of frame b into frame a.
/// - Shapes: arrays of one scan are parallel, with one entry per point.
/// - Threads: plain data.
/// - Errors: none.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dynamic_filter {

using Point = Eigen::Vector3f;      ///< x y z [m]
using Points = std::vector<Point>;  ///< N points in one frame
using Pose = Eigen::Isometry3d;     ///< rigid motion; translation [m]

/// Verdict on a point. The values are those of SemanticKITTI and of the label files.
enum class Label : std::uint8_t { unknown = 0, static_ = 9, dynamic = 251 };
using Labels = std::vector<Label>;  ///< N labels, parallel to the points

/// One sweep of the sensor. Points may be non-finite or at the origin; such points are not used as
/// evidence and get the label `Label::unknown`. Pose and stamp must be finite, and the pose must be
/// rigid: OnlineFilter and the readers refuse other scans, DynamicFilter does not check. If scans
/// have no pose, the filter estimates it (tracking.hpp); then stamps must be in seconds.
struct Scan {
    Points points;                           ///< [m] in the sensor frame, in any order
    Pose T_world_sensor = Pose::Identity();  ///< pose of the sensor at `stamp`
    double stamp = 0.0;                      ///< [s], must not decrease within a recording
    std::size_t index =
        0;  ///< position in the recording; identifies the scan in errors and outputs
    /// False: T_world_sensor has no meaning. Either all scans of a sequence have a pose, or none.
    bool has_pose = true;
    /// Time at which each point was measured, [s] relative to `stamp`. Empty if all points were
    /// measured at once, or if motion compensation was done already. The times are used where the
    /// filter estimates or refines poses: it then does the motion compensation itself.
    std::vector<float> times{};
    /// Which of several sensors on one vehicle made the scan, from 0. Each sensor has beams of its
    /// own, and sees its own part of the surroundings. Within a second, its scans may come after
    /// later ones of another sensor.
    std::size_t sensor = 0;
};

/// True for a point that carries a measurement: finite, and not at the origin of the sensor.
inline bool is_measured(const Point& point) {
    return point.allFinite() && point.squaredNorm() > 0.0F;
}

}  // namespace dynamic_filter
