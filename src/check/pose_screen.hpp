// SPDX-License-Identifier: MIT
/// A short look at given poses, which tells that they are exact, or nothing.
#pragma once

#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/settings.hpp"

namespace dynamic_filter::io {

/// True if the poses of the recording surely are as good as those that could be found: wherever one
/// looks, scans up to 20 apart lie on each other, they hardly lie better where registration moves
/// them, and upright structures overlay less well at any other place nearby. If it is false,
/// measure_motion() tells more, at ten times the cost; it also is if only the scans themselves hold
/// their poses. Reads four scans at each of up to five places.
bool poses_are_exact(const Recording& recording, const OdometryConfig& config);

}  // namespace dynamic_filter::io
