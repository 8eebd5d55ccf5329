// SPDX-License-Identifier: MIT
/// What a scan can say about a place (Sec. III-C2). Plain data.
#pragma once

#include <cstdint>

namespace dynamic_filter {

/// What a scan says about a place.
enum class Sight : std::uint8_t {
    unknown,   ///< it did not look there, or cannot tell
    occupied,  ///< its beams end there
    free       ///< its beams go through
};

}  // namespace dynamic_filter
