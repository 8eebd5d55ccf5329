// SPDX-License-Identifier: MIT
/// How a scan would have to move so that its surfaces fit those of an earlier keyframe. Poses of
/// GPS and inertial sensors drift by decimeters within seconds. Ground that lies a decimeter lower
/// than before would then count as free space above ground, although both scans saw the same
/// surface.
#pragma once

#include <optional>

#include "dynamic_filter/types.hpp"
#include "filter/keyframes.hpp"

namespace dynamic_filter {

/// Some points of a scan, evenly chosen among those at medium range, in the map frame. Enough to
/// align it with alignment_to().
Points alignment_sample(const Scan& scan);

/// The motion in the map that brings a scan, of which a sample is given, onto the surfaces that the
/// keyframe saw: point to plane, robust, from the poses as they are. Empty if they share too few
/// surfaces. It is the identity unless the surfaces fit better by the share `gain` of their
/// misfit, so that poses that are good remain as they are. Thread-safe.
std::optional<Eigen::Isometry3f> alignment_to(const Keyframe& keyframe, const Points& sample,
                                              float gain);

}  // namespace dynamic_filter
