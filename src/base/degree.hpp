// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

namespace dynamic_filter::io {

constexpr double kDegree = std::numbers::pi / 180.0;  ///< [rad]

}  // namespace dynamic_filter::io
