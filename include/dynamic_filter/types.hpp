// SPDX-License-Identifier: MIT
/// The words every module shares. Lengths in metres, angles in radians unless a name says `_deg`,
/// times in seconds. `T_a_b` maps coordinates of frame b into frame a. Frames: *sensor* (one scan),
/// *world* (the poses' frame), *map* (world, shifted to a nearby origin so that floats suffice).
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dynamic_filter {

using Point = Eigen::Vector3f;
using Points = std::vector<Point>;
using Pose = Eigen::Isometry3d;

/// Verdict on a point; the values are SemanticKITTI's and are what label files hold.
enum class Label : std::uint8_t { unknown = 0, still = 9, dynamic = 251 };
using Labels = std::vector<Label>;

/// One sweep of the sensor. Points are in the sensor frame and may be non-finite or at the origin:
/// such points are no evidence and end as `Label::unknown`.
struct Scan {
    Points points;
    Pose T_world_sensor = Pose::Identity();
    double stamp = 0.0;     ///< [s], never decreasing within a sequence
    std::size_t index = 0;  ///< position in the sequence; names the scan in errors and outputs
};

/// True for a point that carries a measurement: finite and not at the sensor's origin.
inline bool is_measured(const Point& point) {
    return point.allFinite() && point.squaredNorm() > 0.0F;
}

}  // namespace dynamic_filter
