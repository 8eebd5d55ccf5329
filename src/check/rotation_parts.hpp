// SPDX-License-Identifier: MIT
/// Finds scans that are parts of a rotation of the sensor, such as the packets of a driver.
#pragma once

#include <optional>

#include "dynamic_filter/check.hpp"

namespace dynamic_filter::io {

/// A finding if each scan covers a part of a rotation, and the next one goes on where it ends.
std::optional<Finding> find_rotation_parts(const Recording& recording);

}  // namespace dynamic_filter::io
