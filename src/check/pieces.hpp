// SPDX-License-Identifier: MIT
/// Consecutive scans at several places of a recording.
#pragma once

#include <cstddef>
#include <vector>

#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/settings.hpp"

namespace dynamic_filter::io {

/// Consecutive scans as input of the odometry.
using Piece = std::vector<Scan>;

/// The first scans of up to `most` pieces of `in_a_row` scans, which cover at most half of the
/// recording. Their places are spread irregularly, so that errors with a period do not hide between
/// them.
std::vector<std::size_t> first_scans(std::size_t scans, std::size_t most, std::size_t in_a_row);

/// The pieces. Scans that cannot be read are left out, and pieces of fewer than two scans.
std::vector<Piece> read_pieces(const Recording& recording, std::size_t most, std::size_t in_a_row);

/// At most `in_a_row` scans from `first` on; those that cannot be read are left out.
Piece read_piece(const Recording& recording, std::size_t first, std::size_t in_a_row);

/// Of the sensor at a scan, from the poses before and after it, in the sensor frame, per second.
Twist velocity_at(const Recording& recording, std::size_t i);

/// The poses that the scans have.
std::vector<Pose> given_poses(const Piece& piece);

/// See thinned_scan().
Piece thinned_piece(const Piece& piece, const OdometryConfig& config);

}  // namespace dynamic_filter::io
