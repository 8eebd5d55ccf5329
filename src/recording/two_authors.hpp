// SPDX-License-Identifier: MIT
/// Poses that two programs published as those of one frame.
#pragma once

#include <array>
#include <optional>

#include "dynamic_filter/poses.hpp"

namespace dynamic_filter::io {

/// The poses of each author, if those of two authors alternate: then the way from pose to pose is
/// much longer than the ways of both. Empty for poses of one author. `poses` are in order.
std::optional<std::array<Trajectory, 2>> split_authors(const Trajectory& poses);

}  // namespace dynamic_filter::io
