// SPDX-License-Identifier: MIT
#pragma once

#include "dynamic_filter/types.hpp"
#include "io/text.hpp"

namespace dynamic_filter::io {

/// The next four lines that are not blank, as the rows of a rigid motion; one that is not finite
/// becomes lost_pose(). Throws InputError.
Pose read_matrix(Lines& lines);

}  // namespace dynamic_filter::io
