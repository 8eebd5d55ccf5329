// SPDX-License-Identifier: MIT
#pragma once

#include "dynamic_filter/io/poses.hpp"
#include "text.hpp"

namespace dynamic_filter::io {

/// CSV with a header that names its columns (EuRoC, ERASOR and the like), or without one and with
/// MulRan's 13 columns. Throws InputError.
PoseFile read_pose_table(Lines& lines);

/// Throws InputError at the current line if the stamp is not finite or goes back.
void append_stamp(PoseFile& file, double stamp, const Lines& where);

}  // namespace dynamic_filter::io
