// SPDX-License-Identifier: MIT
/// Notes about missing poses.
#pragma once

#include <cstddef>
#include <string>

#include "recording/layout.hpp"

namespace dynamic_filter::io {

/// Adds a note with the number of scans that have a non-finite pose, if there are any.
void note_lost(Layout& layout);

/// Returns "; try --poses FILE..." with the files in the folders that look like poses of this
/// number of scans: they have a usual name, or a row of seven or more numbers per scan. Empty if
/// there are none.
std::string offer_poses(std::size_t scans, const Paths& folders);

/// Usual names of pose files, in the order in which they are looked for.
const std::vector<std::string>& pose_names();

}  // namespace dynamic_filter::io
