// SPDX-License-Identifier: MIT
#include "check/motion_look.hpp"

#include <utility>

#include "recording/recording_parts.hpp"

namespace dynamic_filter::io {

MotionLook::MotionLook(const Recording& recording, const OdometryConfig& config, std::string deskew)
    : given_(recording), config_(config), deskew_(std::move(deskew)) {}

const TimesChoice& MotionLook::times() {
    if (times_) return *times_;
    const Info& info = given_.info();
    const bool tells = info.has_poses && !info.sparse_poses && deskew_ != "off";
    times_ = tells ? choose_times(as_measured(given_), config_, deskew_ == "on") : TimesChoice{};
    return *times_;
}

const Recording& MotionLook::recording() {
    if (!looked_at_) looked_at_ = deskew_ == "off" ? given_ : with_times(given_, times().sweep);
    return *looked_at_;
}

const MotionQuality& MotionLook::quality() {
    if (!quality_) quality_ = measure_motion(recording(), config_);
    return *quality_;
}

Recording as_measured(const Recording& recording) {
    RecordingParts parts = recording.parts();
    parts.info.deskewed = false;
    return Recording(std::move(parts));
}

}  // namespace dynamic_filter::io
