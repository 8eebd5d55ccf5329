// SPDX-License-Identifier: MIT
/// Recordings with mistakes.
#pragma once

#include <functional>

#include "recording/recording_parts.hpp"

namespace dynamic_filter::io {

/// The recording with another Info.
inline Recording changed(const Recording& recording, const std::function<void(Info&)>& change) {
    RecordingParts parts = recording.parts();
    change(parts.info);
    return Recording(std::move(parts));
}

/// The recording with other poses.
inline Recording with_changed_poses(const Recording& recording,
                                    const std::function<Pose(const Pose&)>& change) {
    return changed(recording, [&](Info& info) {
        for (Pose& pose : info.T_world_sensor) pose = change(pose);
    });
}

}  // namespace dynamic_filter::io
