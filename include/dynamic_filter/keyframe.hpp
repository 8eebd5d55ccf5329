// SPDX-License-Identifier: MIT
/// @file
/// Keyframes: the scans that act as observers. Only keyframes are used to decide whether a place is
/// occupied or free; the points of all scans are judged.
///
/// - Units: [m], [s].
/// - Frames: any, but the same for both scans.
/// - Ownership: values; arguments are only read.
/// - Threads: plain data and pure functions.
/// - Errors: none.
#pragma once

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// When a scan becomes a keyframe (Sec. III-B): as soon as one of the two limits is reached.
struct KeyframeConfig {
    double interval = 0.25;  ///< [s] after the last keyframe
    double distance = 0.5;   ///< [m] from the last keyframe
};

/// True if `scan` is at least `interval` later than the last keyframe, or at least `distance` away
/// from it.
bool is_keyframe(const Scan& last, const Scan& scan, const KeyframeConfig& config);

}  // namespace dynamic_filter
