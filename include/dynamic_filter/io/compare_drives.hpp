// SPDX-License-Identifier: MIT
/// @file
/// Compares the world frames of several recordings ("drives") at places that two of them pass, and
/// names an offset between the frames.
///
/// - Units: [m], [deg].
/// - Frames: the poses of all drives are read as poses in one world frame. An offset says where the
///   poses of one drive put a thing, relative to where those of the other drive put it.
/// - Shapes: lists.
/// - Ownership: values; the sequences are borrowed and must not be null.
/// - Threads: thread-safe; uses parallel_for. The result does not depend on the number of threads.
/// - Errors: none of its own; scans that cannot be read are skipped.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dynamic_filter/io/preflight.hpp"
#include "dynamic_filter/io/sequence.hpp"

namespace dynamic_filter::io {

/// What the places that two drives pass say about the frames of their poses.
enum class FrameMatch {
    equal,     ///< the scans overlay as they are
    shifted,   ///< one offset makes the scans overlay at nearly all places
    drifting,  ///< scans overlay with an offset that differs from place to place
    unlike,    ///< the drives should meet, but their scans overlay with no offset
    apart,     ///< no place of one drive is near a place of the other
    /// The scans of the common places show too little, cannot be read, or were not looked at.
    not_known,
    same_poses,  ///< both drives have the same poses: they are probably one recording
};

/// The offset of the frame of drive `b` from that of drive `a`.
struct DriveOffset {
    std::size_t a = 0;                         ///< index of a drive
    std::size_t b = 0;                         ///< index of the other drive, greater than `a`
    FrameMatch match = FrameMatch::not_known;  ///< what the other members mean
    /// Smallest horizontal distance [m] between a position of `a` and one of `b`; for distances
    /// above 10 m, it is accurate to about one percent of the lengths of the drives.
    double gap = 0.0;
    std::size_t places = 0;    ///< number of places that were looked at
    std::size_t fitting = 0;   ///< number of those at which the scans of both drives fit together
    std::size_t agreeing = 0;  ///< number of those whose offset is the common one
    /// `b` shows a thing at R (p - pivot) + pivot + shift that `a` shows at p, where R turns by
    /// yaw_deg about the vertical axis. [m] in the world frame.
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    double yaw_deg = 0.0;  ///< [deg] counterclockwise, seen from above
    /// [m] in the world frame: the middle of the places.
    Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
    double least = 0.0;  ///< [m] smallest offset of a single place
    double most = 0.0;   ///< [m] largest offset of a single place
    double spread =
        0.0;  ///< [m] largest difference between the offset of a place and the common one
};

/// Measures the offsets between pairs of drives, in the order (0,1), (0,2), (1,2), (0,3), and so
/// on: 8 scans at each of at most 8 places of a pair. A drive is compared with the three drives
/// before it that it meets at most places; its other pairs are `not_known` or `apart`. Drives
/// without poses are left out.
std::vector<DriveOffset> measure_drive_offsets(std::span<const Sequence* const> drives);

/// Sentences with advice about offsets between drives; empty if nothing is suspicious or if there
/// are fewer than two drives. Of two drives that differ by a constant offset, the one with which
/// fewer others agree is said to be off; otherwise the later one. A drive that meets no other one
/// is reported if no two drives meet, or if it is more than 20 km away from all others. Drives
/// without poses are reported.
std::vector<Finding> compare_drives(std::span<const Sequence* const> drives);

/// The same, for offsets that are known already.
std::vector<Finding> findings_of(std::span<const Sequence* const> drives,
                                 std::span<const DriveOffset> offsets);

}  // namespace dynamic_filter::io
