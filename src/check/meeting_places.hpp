// SPDX-License-Identifier: MIT
/// Finds places that two drives pass.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::io {

using Positions = std::vector<Eigen::Vector3d>;  ///< [m] world, one per scan

/// Positions of the sensor; not finite for scans without a usable pose. Reads the headers of the
/// scans if these hold the poses.
Positions positions_of(const Recording& recording);

/// Two scans that were taken near each other.
struct MeetingPlace {
    std::size_t in_a = 0, in_b = 0;  ///< indices of the scans
};

/// Where two drives meet.
struct Meeting {
    std::vector<MeetingPlace> places;  ///< far apart from each other
    std::size_t passes = 0;            ///< number of all places, one after each 2 m of the way
    double gap = 0.0;                  ///< [m] smallest horizontal distance between the drives
};

/// Greatest horizontal distance [m] between the scans of a place.
constexpr double kMeetingDistance = 10.0;

/// At most `most` places, spread over all places at which the drives pass within kMeetingDistance.
Meeting find_meeting(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b,
                     std::size_t most);

/// Distance [m] driven until each scan; that of scans without a pose is that of the scan before.
std::vector<double> way_of(const Positions& positions);

/// Indices of scans around scan `middle`, itself included: one after each `step` [m] of the way, up
/// to `count` before and `count` after it.
std::vector<std::size_t> scans_around(std::span<const Eigen::Vector3d> positions,
                                      std::size_t middle, double step, std::size_t count);

}  // namespace dynamic_filter::io
