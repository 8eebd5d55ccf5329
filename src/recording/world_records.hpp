// SPDX-License-Identifier: MIT
/// The points of a frame as records in the world, with all their fields.
#pragma once

#include <cstddef>
#include <vector>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::app {

/// The frame's fields; float coordinates become double where the world's origin is so far away that
/// a float would be off by a millimetre or more. `in_world`: as they are.
io::Cloud layout_of(const io::FullScan& frame, bool in_world);

/// The frame's records in the given layout (same fields, x y z perhaps wider), x y z in the world.
std::vector<std::byte> world_records(const io::FullScan& frame, const io::Cloud& layout);

}  // namespace dynamic_filter::app
