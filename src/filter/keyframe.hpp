// SPDX-License-Identifier: MIT
#pragma once

#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// True if `scan` is at least `interval` later than the last keyframe, or at least `distance` away
/// from it.
bool is_keyframe(const Scan& last, const Scan& scan, const KeyframeConfig& config);

}  // namespace dynamic_filter
