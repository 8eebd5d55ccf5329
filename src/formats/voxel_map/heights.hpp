// SPDX-License-Identifier: MIT
#pragma once

#include "formats/voxel_map/map_index.hpp"

namespace dynamic_filter::app {

/// The heights [m] between which colours change.
struct HeightRange {
    double low = 0.0, high = 1.0;
};

/// Between most of the tiles' bottoms and tops, so that a stray voxel does not take the colours.
HeightRange usual_heights(const MapIndex& index);

}  // namespace dynamic_filter::app
