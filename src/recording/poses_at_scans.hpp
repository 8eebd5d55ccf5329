// SPDX-License-Identifier: MIT
/// The poses of scans among poses that were published over time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/poses.hpp"

namespace dynamic_filter::io {

/// How near poses must be in time to give a scan its pose; [s].
struct PoseLimits {
    /// Between a scan and the pose that is taken for its own. A pose that is nearer to another scan
    /// is that of the other one.
    double nearest = 0.05;
    /// Between two poses that are interpolated: the motion from scan to scan is nearly even, that
    /// over a second is not.
    double apart = 0.25;
};

/// For scans with these stamps.
PoseLimits limits_for(const std::vector<double>& stamps);

struct PosesAtScans {
    std::vector<Pose> T_world_sensor;  ///< lost_pose() for scans without a pose
    /// True: scans between the first and the last pose have none, because poses are sparse.
    bool are_sparse = false;
    std::string note{};  ///< how many scans have poses, if `are_sparse`
};

/// `known`: the pose at a stamp, if it is known there. Otherwise a scan has the nearest one of
/// `published`, within the limits.
PosesAtScans poses_at_scans(const std::vector<double>& stamps, const Trajectory& published,
                            const std::function<std::optional<Pose>(double)>& known);

}  // namespace dynamic_filter::io
