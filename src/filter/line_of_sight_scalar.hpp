// SPDX-License-Identifier: MIT
/// Reference implementation of line_of_sight.hpp for one place, in plain arithmetic. Tests compare
/// the vector kernel with it at every instruction-set level.
#pragma once

#include "filter/line_of_sight.hpp"

namespace dynamic_filter {

/// The same as check_lines_of_sight() for one place in the frame of the image; slow. Thread-safe.
Sight line_of_sight(const BeamImage& image, const Beam& place, const SightMargins& margins);

}  // namespace dynamic_filter
