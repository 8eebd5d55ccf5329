// SPDX-License-Identifier: MIT
/// @file
/// What a user is told about a setting, and which method it belongs to.
///
/// - Units: bounds are in the setting's own unit.
/// - Ownership: texts live for ever.
/// - Threads: plain data.
/// - Errors: none.
#pragma once

#include <string_view>

namespace dynamic_filter {

/// How moving objects are found. Scans observe (the default), submaps observe (the paper's), or
/// Removert, the paper's opponent (Table II), which has no back-end.
enum class Method { scans, submaps, removert };

/// What the static map holds: what never moved, or what was there when its place was last seen, so
/// also what came, or moved, and then stayed.
enum class MapTime { always, latest };

/// A set of methods: one bit each.
constexpr unsigned methods_of(Method method) { return 1U << static_cast<unsigned>(method); }
/// Of all methods.
constexpr unsigned kAllMethods = 7U;

/// What a user is told about a setting. Bounds are inclusive; for switches and choices they are 0.
struct Setting {
    std::string_view key;            ///< "map.voxel_size": the path of the field in Config
    std::string_view unit;           ///< "m", "deg", "1", ...
    std::string_view symbol;         ///< the paper's symbol or section
    std::string_view help;           ///< what it does
    double min = 0.0;                ///< in `unit`
    double max = 0.0;                ///< in `unit`
    unsigned methods = kAllMethods;  ///< those in which it has an effect
};

}  // namespace dynamic_filter
