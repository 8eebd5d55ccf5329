// SPDX-License-Identifier: MIT
/// The possible observations of a place by one scan (Sec. III-C2). Plain data.
#pragma once

#include <cstdint>

namespace dynamic_filter {

/// What a scan observes of a place.
enum class Sight : std::uint8_t {
    unknown = 0,        ///< the scan has no beam there, or its beams do not tell
    occupied = 1,       ///< a return lies in the place
    free = 2,           ///< beams pass the place on all sides and end well behind it
    weak_occupied = 5,  ///< the surface between two returns runs through the place
    /// Beams pass the place, but there is no beam on some side of it, or a surface begins just
    /// behind it.
    weak_free = 6,
    passed = 10,      ///< as `free`, and one of the beams went through the place itself
    weak_passed = 14  ///< as `weak_free`, and one of the beams went through the place itself
};

inline bool is_occupied(Sight sight) {
    return sight == Sight::occupied || sight == Sight::weak_occupied;
}
inline bool is_free(Sight sight) { return (static_cast<unsigned>(sight) & 2U) != 0; }
/// True for weak observations; they count less than sure ones.
inline bool is_weak(Sight sight) { return (static_cast<unsigned>(sight) & 4U) != 0; }
/// True if a beam went through the place itself, so that even a thin object there would have been
/// hit.
inline bool is_passed(Sight sight) { return (static_cast<unsigned>(sight) & 8U) != 0; }

}  // namespace dynamic_filter
