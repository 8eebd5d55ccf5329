// SPDX-License-Identifier: MIT
/// @file
/// What the scans said about a voxel, and how likely that makes it to be static (Sec. III-C1).
///
/// - Units: counts, and shares -1..1 or 0..1.
/// - Ownership: values; record() changes what it is given.
/// - Threads: plain data and pure functions.
/// - Errors: none; counters saturate.
#pragma once

#include <cstdint>

#include "dynamic_filter/back_end/sight.hpp"

namespace dynamic_filter {

/// Counters of one voxel; they stop at their largest value.
struct Evidence {
    std::uint16_t owned = 0;        ///< scans with a point in it
    std::uint16_t seen = 0;         ///< n_occ: observers that saw it occupied
    std::uint16_t passed = 0;       ///< n_free: observers that saw through it
    std::uint16_t switches = 0;     ///< changes between the two, in the order of the observers
    Sight last = Sight::nothing;    ///< what the newest observer saw
    std::uint32_t first_owner = 0;  ///< the first scan with a point in it, by their order ...
    std::uint32_t last_owner = 0;   ///< ... and the last
};

/// Takes in what the next observer saw, as if `weight` observers like it had seen it.
void record(Evidence& evidence, Sight sight, unsigned weight = 1);

/// True while none passed it and fewer than two saw it: one of those is the scan that found it.
inline bool is_unknown(const Evidence& e) { return e.seen < 2 && e.passed == 0; }

/// -1..1: whether the voxel was empty most of the time and only crossed by something; below 0: no.
/// A porous surface, an edge or a leaf is passed now and then, between returns; where something
/// came or went, it is passed in few long runs. So n_free is compared with what the number of runs
/// and the number of returns lead one to expect of a static voxel:
///     expected = 0.45 (1 + switches)^0.9 (n_occ owned^2)^0.2
///     (f^2 - e^2) / (f^2 + e^2) with f = n_free + 2 and e = expected + 2.
float transience(const Evidence& evidence);

/// How much of their time two voxels were there together: the overlap of the spans between their
/// first and last owner, over their union, 0..1. Voxels of one thing come and go together.
float co_presence(const Evidence& a, const Evidence& b);

}  // namespace dynamic_filter
