// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace dynamic_filter::io {

/// True if the first line of a text names x, y and z, but no rotation, so that points follow, not
/// poses.
bool names_points(std::string_view head);

}  // namespace dynamic_filter::io
