// SPDX-License-Identifier: MIT
/// The visibility check of the method "scans": whether one scan sees a place occupied, free, or not
/// at all. The scan is used from its own pose, so no point is projected again: along each beam, the
/// space up to its return was free.
#pragma once

#include <vector>

#include "dynamic_filter/settings.hpp"
#include "filter/sight.hpp"
#include "geometry/beam_image.hpp"

namespace dynamic_filter {

/// The constants of the check for voxels of a given size; ScansConfig::Sight explains them. Lengths
/// [m] allow for errors of poses and ranges and for the size of a voxel. All that depends on the
/// sensor comes from the image.
struct SightMargins {
    float beside, beyond, touch, surface, per_metre, nearest, farthest;
    float own_pixels, close_pixels, close_beside, same_spot;
    float clear, clear_unseen;
    float apart = 0.0F;  ///< distance between points that a voxel filter has thinned
};
SightMargins margins_of(const ScansConfig::Sight& config, double voxel_size);

/// Checks each of the places, given in the frame of the image; `sights` is parallel to them.
/// Thread-safe. Source: docs/how-it-works.md, "Line of sight". The answers are:
///
/// - occupied: a return lies at the place. It is within `touch` along the beam, and within `beside`
///   or half a pixel across the beam.
/// - weak_occupied: the line between the returns of the beams below and above the place, at
///   different ranges, runs through it (ground at a large incidence angle).
/// - free or weak_free: all of these conditions hold. In each quadrant around the place, the
///   nearest beam is used; there are at least two such beams. At least one of them went beyond the
///   place. The lines between their returns, vertical and horizontal, run behind the place by the
///   surface margin, so a surface is not taken for free at any incidence angle. No beam beside the
///   place ended in front of it. At the upper or lower border of the image and at holes in it, one
///   beam must pass very close to the place. Above a hole, the place must also lie in front of the
///   line to the next beam farther down.
/// - free: in addition, there is a beam in each of the four quadrants and all of them go on by
///   `clear` or more, or all existing beams go on by `clear_unseen`.
/// - weak_free: the other cases, for example at the upper border of the image, where a ceiling at a
///   large incidence angle looks similar to free space.
/// - unknown: everything else. Beams without a return tell nothing.
///
/// line_of_sight_scalar.hpp does the same for one place, one pixel at a time.
void check_lines_of_sight(const BeamImage& image, const Directions& places,
                          const SightMargins& margins, std::vector<Sight>& sights);

/// False if check_lines_of_sight() would give unknown for every place within `radius` [m] of
/// `center`, because the places are too far, too near, out of view, or behind all returns around
/// them. The answer is conservative: true may be wrong. This quick test saves many checks.
bool may_see(const BeamImage& image, const Beam& center, float radius, const SightMargins& margins);

}  // namespace dynamic_filter
