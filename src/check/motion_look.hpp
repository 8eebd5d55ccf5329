// SPDX-License-Identifier: MIT
/// What some scans show about the motion of a recording at its poses.
#pragma once

#include <optional>
#include <string>

#include "check/scan_times.hpp"
#include "dynamic_filter/check.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/settings.hpp"

namespace dynamic_filter::io {

/// Each part is measured when it is asked for first, because it reads 40 to 100 scans; then it is
/// kept, because a check and the choice of what to do ask for the same. Not thread-safe.
class MotionLook {
public:
    /// `deskew`: "auto", "on" or "off", as for a run.
    MotionLook(const Recording& recording, const OdometryConfig& config, std::string deskew);

    /// Times of the points, if scans overlay better with the motion during them undone; empty
    /// without poses of all scans, or if the motion is not to be undone.
    const TimesChoice& times();
    /// The recording with these times.
    const Recording& recording();
    /// measure_motion() of it.
    const MotionQuality& quality();

    [[nodiscard]] const OdometryConfig& config() const { return config_; }
    [[nodiscard]] const std::string& deskew() const { return deskew_; }

private:
    Recording given_;
    OdometryConfig config_;
    std::string deskew_;
    std::optional<TimesChoice> times_;
    std::optional<Recording> looked_at_;
    std::optional<MotionQuality> quality_;
};

/// The recording without motion compensation.
Recording as_measured(const Recording& recording);

/// As those without it; `look`: of the same recording.
Preflight check_recording(const Recording& recording, Depth depth, MotionLook& look);
std::string find_pose_mistake(MotionLook& look);

}  // namespace dynamic_filter::io
