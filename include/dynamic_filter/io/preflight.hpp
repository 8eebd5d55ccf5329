// SPDX-License-Identifier: MIT
/// Whether the scans of a recording fit together by their poses, and what is wrong if they do not.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "dynamic_filter/io/sequence.hpp"

namespace dynamic_filter::io {

/// A likely mistake.
struct Finding {
    std::string what;    ///< one sentence, with the figures that say so
    std::string advice;  ///< what to do
};

/// How well scans overlay if poses and points are taken in some way: the share of what stands
/// upright that falls on what stands in the other scan, 0..1, over pairs of scans 1 to 20 apart.
struct Overlay {
    std::string reading;  ///< "as given", a PoseFix, "points in world" or "points in sensor"
    double share = 0.0;
};

struct Preflight {
    std::vector<Finding> findings;  ///< empty: nothing suspicious
    std::vector<Overlay> overlays;  ///< "as given" first; empty if no two scans could be compared
    std::size_t scans = 0;          ///< that were read
};

/// Looks at about five scans at each of so many places of the recording. Scans that cannot be read
/// are left out. Reads them one by one; 12 places of a 64-beam recording take a second.
Preflight check_recording(const Sequence& sequence, std::size_t places);

}  // namespace dynamic_filter::io
