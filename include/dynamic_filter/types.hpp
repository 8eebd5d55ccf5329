// SPDX-License-Identifier: MIT
/// @file
/// The words every module shares.
///
/// - Units: lengths in metres, angles in radians unless a name says `_deg`, times in seconds.
/// - Frames: *sensor* (one scan), *world* (the poses' frame), *map* (world, shifted to a nearby
///   origin so that floats suffice); `T_a_b` maps coordinates of frame b into frame a.
/// - Shapes: arrays of one scan are parallel, an entry a point.
/// - Threads: plain data.
/// - Errors: none.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dynamic_filter {

using Point = Eigen::Vector3f;      ///< x y z [m]
using Points = std::vector<Point>;  ///< N of them, in one frame
using Pose = Eigen::Isometry3d;     ///< rigid; translation [m]

/// Verdict on a point; the values are SemanticKITTI's and are what label files hold.
enum class Label : std::uint8_t { unknown = 0, static_ = 9, dynamic = 251 };
using Labels = std::vector<Label>;  ///< N of them, parallel to the points

/// One sweep of the sensor. Points are in the sensor frame and may be non-finite or at the origin:
/// such points are no evidence and end as `Label::unknown`. Pose and stamp must be finite, the pose
/// rigid: OnlineFilter and the readers refuse others, DynamicFilter does not look. Without a pose,
/// the filter finds it (odometry.hpp), and needs a stamp in seconds.
struct Scan {
    Points points;                           ///< [m] sensor frame, unordered
    Pose T_world_sensor = Pose::Identity();  ///< where the sensor was at `stamp`
    double stamp = 0.0;                      ///< [s], never decreasing within a sequence
    std::size_t index = 0;  ///< position in the sequence; names the scan in errors and outputs
    bool has_pose = true;   ///< false: T_world_sensor means nothing; all scans have one, or none
    /// When each point was measured, [s] from `stamp`; empty: all at once, or their motion is
    /// undone. Of use where the filter finds or refines poses: it undoes the motion itself.
    std::vector<float> times{};
};

/// True for a point that carries a measurement: finite and not at the sensor's origin.
inline bool is_measured(const Point& point) {
    return point.allFinite() && point.squaredNorm() > 0.0F;
}

}  // namespace dynamic_filter
