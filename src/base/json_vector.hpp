// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <nlohmann/json.hpp>

namespace dynamic_filter::app {

/// To a millimetre, so that rounding of the last bits is not written.
inline double rounded(double value) { return std::round(value * 1000.0) / 1000.0; }
inline Eigen::Vector3d rounded(const Eigen::Vector3d& v) {
    return {rounded(v.x()), rounded(v.y()), rounded(v.z())};
}

inline nlohmann::ordered_json array_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace dynamic_filter::app
