// SPDX-License-Identifier: MIT
/// Finds the poses of a drive in the world of other drives.
#pragma once

#include <span>
#include <vector>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::io {

struct PlacedDrive {
    std::vector<Pose> T_world_sensor;     ///< by scan; not finite where the drive has none
    std::size_t places = 0, fitting = 0;  ///< that were compared, and that lie on each other
    double fit = 0.0;  ///< 0..1: see PlaceOffset; the median of the fitting places
    /// 0..1: of the upright points where the map was seen, the share that its scans saw through;
    /// the median of the fitting places.
    double through = 0.0;
    double moved = 0.0;     ///< [m] the largest correction of a position
    bool is_found = false;  ///< true: its own world was another one

    /// False: too few places show that it is the same world, or they only look alike.
    [[nodiscard]] bool fits() const;
};

/// The poses of `drive` tell how it went, in a world of its own or nearly in that of `drives`.
/// Where it passes the other drives within 10 m and lies on them, these places lead; where it does
/// not, the drive is found on them by what places look like from above. The way is then bent until
/// all places fit. Places that the other drives do not pass follow the drive's own way. Reads up to
/// 1,000 places of the other drives, of up to five scans each.
PlacedDrive place_drive(const Recording& drive, std::span<const Recording* const> drives);

}  // namespace dynamic_filter::io
