// SPDX-License-Identifier: MIT
/// What several outputs need of a cloud.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamic_filter/cloud.hpp"

namespace dynamic_filter::app {

/// x y z of each point.
std::vector<Eigen::Vector3d> places_of(const io::Cloud& cloud);
/// All but the records.
io::Cloud without_records(const io::Cloud& cloud);

}  // namespace dynamic_filter::app
