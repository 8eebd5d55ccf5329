// SPDX-License-Identifier: MIT
/// What the scans said about a voxel, and how likely that makes it to be static.
#pragma once

#include <cstdint>

#include "dynamic_filter/back_end/line_of_sight.hpp"

namespace dynamic_filter {

/// Counters of one voxel; they stop at their largest value.
struct Evidence {
    std::uint16_t owned = 0;     ///< scans with a point in it
    std::uint16_t seen = 0;      ///< n_occ: observers that saw it occupied
    std::uint16_t passed = 0;    ///< n_free: observers that saw through it
    std::uint16_t switches = 0;  ///< changes between the two, in the order of the observers
    Sight last = Sight::nothing;
    std::uint32_t first_owner = 0, last_owner = 0;  ///< scans that own it, by their order
};

/// Takes in what the next observer saw.
void record(Evidence& evidence, Sight sight);

/// True while fewer than two observers have an opinion on the voxel.
inline bool is_unknown(const Evidence& e) { return e.seen + e.passed < 2; }

/// Log-odds, within +-2, that the voxel was empty most of the time and only crossed by something.
/// A porous surface, an edge or a leaf is passed now and then, between returns; where something
/// came or went, it is passed in few long runs. So n_free is compared with what the number of runs
/// and the number of returns lead one to expect of a static voxel:
///     n_free / (0.9 switches^3/4 (n_occ owned)^1/4),
/// shrunk towards 0 while observers are few. Below 0: static.
float transience(const Evidence& evidence);

/// How much of their time two voxels were there together: the overlap of the spans between their
/// first and last owner, over their union, 0..1. Voxels of one thing come and go together.
float co_presence(const Evidence& a, const Evidence& b);

}  // namespace dynamic_filter
