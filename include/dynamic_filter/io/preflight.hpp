// SPDX-License-Identifier: MIT
/// @file
/// Whether the scans of a recording fit together by their poses, and what is wrong if they do not.
///
/// - Units: shares 0..1.
/// - Shapes: lists; findings on stamps come first, then on points, then on poses.
/// - Ownership: values; the sequence is borrowed.
/// - Threads: thread-safe; uses parallel_for.
/// - Errors: none of its own; scans that cannot be read are in `unusable`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "dynamic_filter/io/sequence.hpp"

namespace dynamic_filter::io {

/// A likely mistake.
struct Finding {
    std::string what;    ///< one sentence, with the figures that say so
    std::string advice;  ///< what to do: an option ("--...") to try, or a sentence
};

/// How well scans overlay if poses and points are taken in some way: the share of what stands
/// upright that falls on what stands in the other scan, 0..1, over pairs of scans 1 to 20 apart.
struct Overlay {
    std::string reading;  ///< "as given", a PoseFix, "points in world" or "points in sensor"
    double share = 0.0;   ///< 0..1
};

/// What was found.
struct Preflight {
    std::vector<Finding> findings;  ///< empty: nothing suspicious
    std::vector<Overlay> overlays;  ///< "as given" first; empty if no two scans could be compared
    std::size_t scans = 0;          ///< that were read
    std::vector<std::string> unusable;  ///< scans that a run would reject, and why: of all, what
                                        ///< shows without reading, and of those looked at, the rest
};

/// Quick: about 15 scans; finds what makes the scans overlay badly as a whole. Thorough: 60, and
/// looks whether moving them about makes them fit better.
enum class Depth { quick, thorough };

/// Looks at a few scans at each of some places of the recording. Thorough takes a second or two for
/// 64 beams, quick a tenth of one.
Preflight check_recording(const Sequence& sequence, Depth depth);

}  // namespace dynamic_filter::io
