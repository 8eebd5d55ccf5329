// SPDX-License-Identifier: MIT
/// What a simulation knows of a point, and nobody who only sees the scans: how often somebody saw
/// through its place, and whether somebody saw its thing move.
#pragma once

#include <cstdint>

namespace dynamic_filter {

/// What the thing of a point does at that moment. It was seen to move if it did so in another scan
/// with at least 20 points of it.
enum class ThingState : std::uint8_t {
    still,      ///< the point is static
    moves,      ///< moves now
    moved,      ///< rests, and was seen to move before
    will_move,  ///< rests, and will only be seen to move later
    never       ///< rests, and is never seen to move
};

struct KnowablePoint {
    /// Of the whole recording, that passed through the point's voxel while it was empty; 65535
    /// stands for as many or more. 0 for static points, whose voxels are not counted.
    std::uint16_t beams = 0;
    ThingState state = ThingState::still;
    bool is_seen_moving = false;  ///< the thing, in any scan, with at least 20 points of it

    bool operator==(const KnowablePoint&) const = default;
};

}  // namespace dynamic_filter
