// SPDX-License-Identifier: MIT
/// @file
/// The description of a setting, and the methods that use it.
///
/// - Units: bounds are in the unit of the setting.
/// - Ownership: texts are string literals and stay valid for the whole program.
/// - Threads: plain data.
/// - Errors: none.
#pragma once

#include <string_view>

namespace dynamic_filter {

/// How moving objects are found. "scans" (the default): each keyframe is an observer. "submaps":
/// the submaps are the observers, as in the paper. "removert": Removert, with which the paper
/// compares (Table II); it has no back-end.
enum class Method { scans, submaps, removert };

/// What the static map holds. `always`: only what never moved. `latest`: what was in each place
/// when the place was last seen, so also objects that came or moved and then stayed.
enum class MapTime { always, latest };

/// A set of methods, with one bit per method.
constexpr unsigned methods_of(Method method) { return 1U << static_cast<unsigned>(method); }
/// The set of all methods.
constexpr unsigned kAllMethods = 7U;

/// The description of a setting for users. Bounds are inclusive; for switches and choices both are
/// 0.
struct Setting {
    std::string_view key;            ///< path of the field in Config, such as "map.voxel_size"
    std::string_view unit;           ///< "m", "deg", "1", ...
    std::string_view symbol;         ///< the symbol or the section of the paper
    std::string_view help;           ///< what the setting does
    double min = 0.0;                ///< in `unit`
    double max = 0.0;                ///< in `unit`
    unsigned methods = kAllMethods;  ///< the methods in which it has an effect
};

}  // namespace dynamic_filter
