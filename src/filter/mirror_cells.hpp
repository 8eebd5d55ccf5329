// SPDX-License-Identifier: MIT
/// Which parts of an upright plane reflect: those behind which most places have their like in
/// front.
#pragma once

#include <cstdint>
#include <span>

#include "filter/mirror.hpp"

namespace dynamic_filter {

/// What a place behind a plane has in front of it, at its place in the mirror.
enum class Likeness : std::uint8_t { unknown, like, unlike, plain };

/// A mirror, and how well it is known: the number of places behind it that have their like, less
/// four for each that has not, because these are few only where the plane is exact.
struct MarkedMirror {
    Mirror mirror;
    int like = 0;
};

/// The mirror in the plane that was seen at these places, of which there is at least one. The cells
/// reflect behind which at least `least` places, and more than `share` of those that tell anything,
/// have their like. Source: docs/how-it-works.md, "Mirrors".
MarkedMirror mark_mirror(const UprightPlane& plane, std::span<const Crossing> seen,
                         std::span<const Likeness> likeness, double share, int least);

}  // namespace dynamic_filter
