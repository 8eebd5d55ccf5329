// SPDX-License-Identifier: MIT
/// Which things of a recording move, and which were seen to move.
///
/// A thing moves if both ends of what is seen of it go on by more than 0.5 m/s, over half a second
/// around the scan. So one that is uncovered step by step does not.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "dynamic_filter/simulation.hpp"
#include "geometry/knowable.hpp"

namespace dynamic_filter::sim {

/// Tells the person or vehicle of a point from all others; 0: static, or the reflection of
/// something static, which is no thing. Things of Kind::temporary are numbered on their own, and so
/// are reflections.
inline std::uint32_t thing_of(Kind kind, std::uint16_t instance) {
    if (!is_dynamic(kind)) return 0;
    const bool is_reflected_still = kind == Kind::reflection && instance == 0;
    if (is_reflected_still) return 0;
    const std::uint32_t more = kind == Kind::temporary ? 1U : kind == Kind::reflection ? 2U : 0U;
    return instance | more << 16U;
}

/// What is seen of a thing in a scan, from above.
struct SeenThing {
    Eigen::AlignedBox2d box;  ///< [m] in the world
    std::size_t points = 0;
};
using SeenThings = std::map<std::uint32_t, SeenThing>;

/// What is seen in one scan. `world` [m] and `things` are parallel; points of thing 0 are left out.
SeenThings seen_things(std::span<const Eigen::Vector3d> world,
                       std::span<const std::uint32_t> things);

struct StateOfThing {
    ThingState state = ThingState::never;
    bool is_seen_moving = false;  ///< in any scan, with at least 20 points
};
using StatesOfThings = std::map<std::uint32_t, StateOfThing>;

/// The states of all things that are seen, by scan. `stamps` [s] are parallel to the scans.
std::vector<StatesOfThings> states_of(std::span<const SeenThings> scans,
                                      std::span<const double> stamps);

}  // namespace dynamic_filter::sim
