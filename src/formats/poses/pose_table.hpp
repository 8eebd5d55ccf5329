// SPDX-License-Identifier: MIT
#pragma once

#include "base/text.hpp"
#include "dynamic_filter/poses.hpp"

namespace dynamic_filter::io {

/// Reads a CSV file with a header that names its columns (EuRoC, ERASOR and others), or one without
/// a header that has MulRan's 13 columns. Throws InputError.
PoseFile read_pose_table(Lines& lines);

/// Appends a stamp. Throws InputError at the current line if the stamp is not finite or smaller
/// than the previous one.
void append_stamp(PoseFile& file, double stamp, const Lines& where);

}  // namespace dynamic_filter::io
