// SPDX-License-Identifier: MIT
/// @file
/// Keyframes: the scans that observe. The others only give points.
///
/// - Units: [m], [s].
/// - Frames: any, the same for both scans.
/// - Ownership: values; arguments are only read.
/// - Threads: plain data and pure functions.
/// - Errors: none.
#pragma once

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// When a scan becomes a keyframe (Sec. III-B): whichever of the two is reached first.
struct KeyframeConfig {
    double interval = 0.25;  ///< [s] after the last keyframe
    double distance = 0.5;   ///< [m] from the last keyframe
};

/// True if `scan` comes late enough after the last keyframe, or far enough from it, to be one too.
bool is_keyframe(const Scan& last, const Scan& scan, const KeyframeConfig& config);

}  // namespace dynamic_filter
