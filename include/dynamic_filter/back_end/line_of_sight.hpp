// SPDX-License-Identifier: MIT
/// What one scan says about one place: the visibility check with scans as observers. Nothing is
/// re-projected: a beam that ended somewhere was free before, seen from its own pose.
#pragma once

#include <vector>

#include "dynamic_filter/back_end/sight.hpp"
#include "dynamic_filter/geometry/beam_image.hpp"

namespace dynamic_filter {

/// Lengths [m] of the check. They bound what poses and ranges may be wrong by, and what a voxel
/// blurs; what depends on the sensor comes from the image.
struct SightMargins {
    float beside = 0.1F;       ///< beams this near the place must agree before it counts as passed
    float beyond = 0.2F;       ///< ... and one must have gone this much farther
    float touch = 0.15F;       ///< a return this near the place occupies it ...
    float surface = 0.1F;      ///< ... and so does a surface between neighbouring returns
    float per_metre = 0.007F;  ///< growth of the last two with range: 0.4 deg of pose error
    float nearest = 0.3F;      ///< no judgement on places nearer to the sensor,
    float farthest = 80.0F;    ///< or farther from it
};

/// Judges each of the places, in the image's frame; `sights` goes parallel to them. Thread-safe.
///
/// occupied: a return lies at the place (within `touch`, and across the beam within `beside` or
/// half a pixel), or the line between the beams below and above it, at different ranges, runs
/// through it (ground at grazing angles). passed: of the nearest beams around the place, at most
/// one in each quadrant and at least two, one went beyond it; above and below the image, or a hole
/// in it, such a beam all but meets the place; the lines between them, up-down and left-right, run
/// behind it by the surface margin, so a surface seen at any incidence is not passed; none beside
/// it ended before it. nothing: all else; where no beam returned, nothing is known.
void look(const BeamImage& image, const Directions& places, const SightMargins& margins,
          std::vector<Sight>& sights);

/// False if look() finds nothing at any place within `radius` [m] of `center`, because it is too
/// far or too near, out of view, or all beams around it end before it. Cautious and quick: one
/// question saves many.
bool may_see(const BeamImage& image, const Beam& center, float radius, const SightMargins& margins);

}  // namespace dynamic_filter
