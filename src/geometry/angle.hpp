// SPDX-License-Identifier: MIT
/// Angles of single points, the same on every machine: versions of the C library differ in the last
/// bit of atan2f and its kin, but not in a double that is rounded.
#pragma once

#include <cmath>

namespace dynamic_filter {

inline float angle_of(float y, float x) {
    return static_cast<float>(std::atan2(static_cast<double>(y), static_cast<double>(x)));
}
inline float angle_of_tangent(float tangent) {
    return static_cast<float>(std::atan(static_cast<double>(tangent)));
}
inline float angle_of_sine(float sine) {
    return static_cast<float>(std::asin(static_cast<double>(sine)));
}

}  // namespace dynamic_filter
