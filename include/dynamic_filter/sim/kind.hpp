// SPDX-License-Identifier: MIT
/// @file
/// What a simulated point lies on: errors are tabulated by it. Plain data.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace dynamic_filter::sim {

/// Walking and standing are people, by what they do at that moment.
enum class Kind : std::uint8_t {
    ground,      ///< floor, pavement, kerbs, tops of steps and ramps
    structure,   ///< buildings, blocks, furniture, parked cars
    thin,        ///< less than about 0.3 m across: poles, signs, railings, trunks
    vegetation,  ///< leaves
    walking,     ///< people on foot who move at that moment ...
    standing,    ///< ... and who do not
    vehicle      ///< those that move or halt on their way; cyclists too
};

/// By their values.
constexpr std::array<std::string_view, 7> kind_names = {
    "ground", "structure", "thin", "vegetation", "walking", "standing", "vehicle"};

/// Points of these kinds are labelled dynamic, the others still.
constexpr bool is_dynamic(Kind kind) { return kind >= Kind::walking; }

}  // namespace dynamic_filter::sim
