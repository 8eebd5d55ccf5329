// SPDX-License-Identifier: MIT
/// What one scan says about one place: the visibility check with scans as observers. Nothing is
/// re-projected: a beam that ended somewhere was free before, seen from its own pose.
#pragma once

#include <vector>

#include "dynamic_filter/config.hpp"
#include "dynamic_filter/geometry/beam_image.hpp"
#include "dynamic_filter/scans_observe/sight.hpp"

namespace dynamic_filter {

/// The constants of the check, as ScansConfig::Sight explains them, for voxels of a certain size:
/// lengths [m] bound what poses and ranges may be wrong by, and what a voxel blurs; what depends on
/// the sensor comes from the image.
struct SightMargins {
    float beside, beyond, touch, surface, per_metre, nearest, farthest;
    float own_pixels, close_pixels, close_beside, same_spot;
    float clear, clear_unseen;
};
SightMargins margins_of(const ScansConfig::Sight& config, double voxel_size);

/// Judges each of the places, in the image's frame; `sights` goes parallel to them. Thread-safe.
///
/// occupied: a return lies at the place (within `touch`, and across the beam within `beside` or
/// half a pixel). weak_occupied: the line between the beams below and above it, at different
/// ranges, runs through it (ground at grazing angles). free or weak_free: of the nearest beams
/// around the place, at most one in each quadrant and at least two, one went beyond it; above and
/// below the image, or a hole in it, such a beam all but meets the place; the lines between them,
/// up-down and left-right, run behind it by the surface margin, so a surface seen at any incidence
/// is not free; none beside it ended before it. free: and there is one in each of the four
/// quadrants, all going on by `clear` or more, or all that there are go on by `clear_unseen`;
/// weak_free: the rest, as at the upper border of the image, where a ceiling at a grazing angle
/// looks much the same. unknown: all else; where no beam returned, nothing is known.
///
/// line_of_sight_scalar.hpp says the same for one place, one pixel at a time.
void check_lines_of_sight(const BeamImage& image, const Directions& places,
                          const SightMargins& margins, std::vector<Sight>& sights);

/// False if check_lines_of_sight() finds nothing at any place within `radius` [m] of `center`,
/// because it is too far or too near, out of view, or all beams around it end before it. Cautious
/// and quick: one question saves many.
bool may_see(const BeamImage& image, const Beam& center, float radius, const SightMargins& margins);

}  // namespace dynamic_filter
