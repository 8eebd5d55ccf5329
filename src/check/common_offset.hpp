// SPDX-License-Identifier: MIT
/// Finds the one correction that explains the corrections of many places.
#pragma once

#include <span>
#include <vector>

#include "check/place_offset.hpp"

namespace dynamic_filter::io {

/// A turn by `yaw` about the vertical through `pivot`, and then a shift.
struct CommonOffset {
    Eigen::Vector3d pivot = Eigen::Vector3d::Zero();  ///< [m] world: the middle of the places
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< [m] world
    double yaw = 0.0;                                 ///< [rad] counterclockwise
    /// [m] Difference between the correction of each place and this one, in the directions that the
    /// place shows. A turn counts as the shift that is as unlikely.
    std::vector<double> differences;

    /// Number of places whose difference is below 0.1 m.
    [[nodiscard]] std::size_t agreeing() const;
    /// True if most places agree.
    [[nodiscard]] bool is_agreed() const;
};

/// Differences of the places from no correction at all.
CommonOffset no_offset(std::span<const PlaceOffset> places);

/// The correction on which most places agree. Single places that do not fit have little weight
/// (Geman and McClure's kernel, graduated non-convexity).
CommonOffset fit_common(std::span<const PlaceOffset> places);

}  // namespace dynamic_filter::io
