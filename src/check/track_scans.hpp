// SPDX-License-Identifier: MIT
/// The poses of all scans of a recording by odometry, and how they are tied to each other and to
/// given ones.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/tracking.hpp"

namespace dynamic_filter::io {

using TrackedScans = std::vector<std::optional<Tracked>>;  ///< by scan; empty: cannot be read

/// The odometry over all scans; it begins a new map where it was lost for long. Poses of the
/// recording are first guesses, as long as they predict what it finds. `after` is called after each
/// scan; if it returns false, the work stops.
TrackedScans follow(const Recording& recording, const OdometryConfig& config,
                    const std::function<bool()>& after);

/// Closes loops, and ties the trajectory to the poses of the recording, if it has some and
/// `to_given`: over short distances the odometry holds, over long ones the given poses. The frame
/// is that of the given poses.
TrackedScans bind_poses(const Recording& recording, TrackedScans tracked, bool to_given);

}  // namespace dynamic_filter::io
