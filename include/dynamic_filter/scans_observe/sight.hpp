// SPDX-License-Identifier: MIT
/// What a scan can say about a place (Sec. III-C2). Plain data.
#pragma once

#include <cstdint>

namespace dynamic_filter {

/// What a scan says about a place.
enum class Sight : std::uint8_t {
    unknown = 0,        ///< it did not look there, or cannot tell
    occupied = 1,       ///< one of its beams ends there
    free = 2,           ///< its beams go through, well clear of anything
    weak_occupied = 5,  ///< a surface between its beams runs through it
    weak_free = 6,      ///< its beams go through, but some side of the place was not looked at, or
                        ///< something begins just behind it
    passed = 10,        ///< free, and one of the beams went through the place itself, not beside it
    weak_passed = 14    ///< weak_free, and so
};

inline bool is_occupied(Sight sight) {
    return sight == Sight::occupied || sight == Sight::weak_occupied;
}
inline bool is_free(Sight sight) { return (static_cast<unsigned>(sight) & 2U) != 0; }
/// It counts less than one that is sure.
inline bool is_weak(Sight sight) { return (static_cast<unsigned>(sight) & 4U) != 0; }
/// A beam went through the place itself: had something thin been there, it would have been hit.
inline bool is_passed(Sight sight) { return (static_cast<unsigned>(sight) & 8U) != 0; }

}  // namespace dynamic_filter
