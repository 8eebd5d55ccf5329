// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace dynamic_filter::app {

inline nlohmann::ordered_json array_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace dynamic_filter::app
