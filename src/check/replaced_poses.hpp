// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "dynamic_filter/check.hpp"
#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::io {

/// What is wrong with given poses that were replaced by refined or found ones: readings of them, as
/// check_recording() knows them, that agree with the poses in `used` much better than the poses as
/// given do. Empty if there is none. Both have the same scans.
std::vector<Finding> mistakes_in_replaced(const Recording& given, const Recording& used);

/// True if the mistake is one of the points, which other poses do not mend.
bool is_of_points(const Finding& finding);

}  // namespace dynamic_filter::io
