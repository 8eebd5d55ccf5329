// SPDX-License-Identifier: MIT
/// What a place looks like from above, so that it is known again from another direction and without
/// a pose (after Scan Context, Kim and Kim 2018).
#pragma once

#include <Eigen/Core>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Heights above the lowest points, in rings and sectors around the place.
struct PlaceSignature {
    static constexpr int kRings = 20, kSectors = 60;
    Eigen::Matrix<float, kRings, kSectors> heights = decltype(heights)::Zero();  ///< [m]; 0: empty
};

/// `cloud`: relative to the place, with the z axis up.
PlaceSignature signature_of(const Points& cloud);

struct Likeness {
    double distance = 1.0;  ///< 0 (alike) to 1
    double turn = 0.0;      ///< [rad] about z: turned by it, b lies on a; in steps of a sector
};

/// By the turn for which both are most alike.
Likeness likeness_of(const PlaceSignature& a, const PlaceSignature& b);

}  // namespace dynamic_filter::io
