// SPDX-License-Identifier: MIT
/// @file
/// Checks whether the scans of a recording fit together at its poses, and finds the likely mistake
/// if they do not.
///
/// - Units: shares 0..1.
/// - Shapes: lists. Findings about stamps come first, then those about points, then about poses.
/// - Ownership: values; the sequence is borrowed.
/// - Threads: thread-safe; uses parallel_for.
/// - Errors: none of its own; scans that cannot be read are listed in `unusable`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "dynamic_filter/io/sequence.hpp"

namespace dynamic_filter::io {

/// A likely mistake in the recording or in the options.
struct Finding {
    std::string what;    ///< one sentence with the measured values
    std::string advice;  ///< what to do: an option to try ("--..."), or a sentence
};

/// How well scans overlay if poses and points are interpreted in a certain way. It is the share,
/// 0..1, of upright structures that fall on upright structures of another scan, over pairs of scans
/// that are 1 to 20 scans apart.
struct Overlay {
    /// The interpretation: "as given", a PoseFix, "points in world" or "points in sensor".
    std::string reading;
    double share = 0.0;  ///< 0..1
};

/// Result of the check.
struct Preflight {
    std::vector<Finding> findings;  ///< empty if nothing is suspicious
    /// "as given" is first; empty if no two scans could be compared.
    std::vector<Overlay> overlays;
    std::size_t scans = 0;  ///< number of scans that were read
    /// Scans that a run would reject, with the reason. Faults that show without reading the points
    /// are listed for all scans, other faults only for the scans that were read.
    std::vector<std::string> unusable;
};

/// How much is checked. `quick` reads about 15 scans, and finds what makes scans overlay badly as a
/// whole. `thorough` reads about 60 scans, and also tests whether small displacements of the scans
/// improve the overlay.
enum class Depth { quick, thorough };

/// Checks some scans at each of several places of the recording. With 64 beams, `thorough` takes
/// one to two seconds, and `quick` about a tenth of a second.
Preflight check_recording(const Sequence& sequence, Depth depth);

}  // namespace dynamic_filter::io
