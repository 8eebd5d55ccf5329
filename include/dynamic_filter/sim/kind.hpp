// SPDX-License-Identifier: MIT
/// @file
/// The kind of object on which a simulated point lies; errors are tabulated by kind. Plain data.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace dynamic_filter::sim {

/// Kinds of objects. People are `walking` or `standing`, depending on what they do at that moment.
enum class Kind : std::uint8_t {
    ground,      ///< floor, pavement, kerbs, tops of steps and ramps
    structure,   ///< buildings, blocks, furniture, parked cars
    thin,        ///< less than about 0.3 m across: poles, signs, railings, trunks
    vegetation,  ///< leaves
    walking,     ///< people on foot who move at that moment
    standing,    ///< people on foot who stand still at that moment
    vehicle,     ///< vehicles and cyclists that move, or that halt on their way
    temporary  ///< what rests during a drive, but is absent from another: parked cars, site fences
};

/// Names of the kinds, indexed by the value of Kind.
constexpr std::array<std::string_view, 8> kind_names = {
    "ground", "structure", "thin", "vegetation", "walking", "standing", "vehicle", "temporary"};

/// True for the kinds whose points are labelled dynamic; all other points are labelled static.
constexpr bool is_dynamic(Kind kind) { return kind >= Kind::walking; }

}  // namespace dynamic_filter::sim
