// SPDX-License-Identifier: MIT
#pragma once

#include "base/text.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Reads the next four lines that are not blank as a rigid motion. A matrix with non-finite numbers
/// becomes lost_pose(). Throws InputError.
Pose read_matrix(Lines& lines);

}  // namespace dynamic_filter::io
