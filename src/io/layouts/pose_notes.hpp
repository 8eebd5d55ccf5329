// SPDX-License-Identifier: MIT
/// What is said about poses that are missing.
#pragma once

#include <cstddef>
#include <string>

#include "io/layout.hpp"

namespace dynamic_filter::io {

/// Notes how many of the scans have a pose that is not finite, if any.
void note_lost(Layout& layout);

/// "; try --poses FILE..." with what in the folders looks like the poses of so many scans: a usual
/// name, or a row of seven or more numbers for each scan. Empty if nothing does.
std::string offer_poses(std::size_t scans, const Paths& folders);

/// The names under which a pose file is looked for.
const std::vector<std::string>& pose_names();

}  // namespace dynamic_filter::io
