// SPDX-License-Identifier: MIT
/// The specification of line_of_sight.hpp: what one scan says about one place, in plain arithmetic.
/// The vector kernel is tested against it at every instruction-set level.
#pragma once

#include "dynamic_filter/scans_observe/line_of_sight.hpp"

namespace dynamic_filter {

/// As check_lines_of_sight(), for one place in the image's frame; slow. Thread-safe.
Sight line_of_sight(const BeamImage& image, const Beam& place, const SightMargins& margins);

}  // namespace dynamic_filter
