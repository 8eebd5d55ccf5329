// SPDX-License-Identifier: MIT
/// Chooses the poses of a recording by evidence: those that it has, where single ones lie apart
/// mended ones, those refined by odometry, or those that odometry alone finds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "check/motion_look.hpp"
#include "check/track_scans.hpp"

namespace dynamic_filter::io {

struct PosesChoice {
    TrackedScans tracked;            ///< empty: the poses of the recording are kept
    std::vector<std::string> notes;  ///< what was chosen and why, a sentence each
};

/// Indices of scans whose poses are not known; empty if the files of the scans hold the poses.
std::vector<std::size_t> scans_without_pose(const Recording& recording);
/// "3 of 60 scans have no pose of their own"
std::string missing_text(const Recording& recording, std::size_t missing);

/// Names given poses that lie apart from those of their neighbours, in a sentence; "" if none does.
std::string outliers_text(const Recording& recording);

/// Tells why poses of the recording may be wrong, in a sentence; "" if they fit its scans as well
/// as poses that odometry finds, at each of several places. Scans without a pose, and poses apart
/// from those of their neighbours, are told as well.
std::string doubt_about_poses(MotionLook& look);

/// Tracks all scans, and compares how they overlay at the given, the refined and the found poses.
/// `asked`: the given ones are not kept, whatever the scans show. `after`: see follow().
PosesChoice choose_poses(const Recording& recording, const OdometryConfig& config, bool asked,
                         const std::function<bool()>& after);

}  // namespace dynamic_filter::io
