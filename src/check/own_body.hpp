// SPDX-License-Identifier: MIT
#pragma once

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::io {

/// What moves with the sensor: the vehicle, a mast, an operator on it, a trailer.
struct OwnBody {
    Boxes boxes;         ///< sensor frame, edges of 0.2 m and more; empty: none was found
    double share = 0.0;  ///< of the points of the scans that were looked at
};

/// A place in the sensor frame belongs to the own body if nearly all scans have a point there, and
/// if other scans look through the places in the world where these points were. (Flat ground
/// around the sensor looks alike in all scans as well, but no scan looks through it.) Looks at
/// pairs of scans some metres apart, so nothing is found if the sensor hardly moves. `recording`:
/// with poses, without motion compensation.
OwnBody find_own_body(const Recording& recording);

}  // namespace dynamic_filter::io
