// SPDX-License-Identifier: MIT
/// @file
/// What the filter says about a scan, about a voxel, and why.
///
/// - Units: [m], probabilities 0..1.
/// - Frames: world.
/// - Shapes: verdicts are parallel to the points of their scan.
/// - Ownership: values.
/// - Threads: plain data.
/// - Errors: none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "dynamic_filter/odometry/odometry.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Verdict on one scan, point by point.
struct Verdict {
    std::size_t index = 0;           ///< Scan::index
    Labels labels;                   ///< one per point
    std::vector<float> probability;  ///< occupancy 0..1 of the point's voxel, 0 where the label is
                                     ///< unknown (a point that stands on a static surface may be
                                     ///< dynamic all the same); empty in instant verdicts
    std::vector<bool> stays{};       ///< with `map.time` = latest, in final verdicts: true for
                                     ///< points of what moves that were still there when their
                                     ///< place was last seen; else empty
    /// In instant verdicts, where the filter found or refined the pose: which it is, and how the
    /// sensor moved. The world is then the first scan's sensor frame, or that of the given poses.
    std::optional<Tracked> tracked{};
};

/// Every point unknown, with probabilities.
inline Verdict unknown_verdict(const Scan& scan) {
    return {scan.index, Labels(scan.points.size(), Label::unknown),
            std::vector<float>(scan.points.size(), 0.0F)};
}

/// What judging a scan gives.
struct Judged {
    std::vector<Verdict> verdicts;    ///< instant ones, see DynamicFilter::push()
    std::function<void()> integrate;  ///< work that can wait until the verdicts are delivered;
                                      ///< empty: none. To be called once, while the filter lives.
};

/// A voxel of a static map.
struct StaticVoxel {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m] world frame
    float probability = 0.0F;                          ///< occupancy 0..1
};

/// What the scans said about a voxel, to explain the verdict on a point in it. Where submaps
/// observe, only the probability is known, and the rest is zero.
struct VoxelHistory {
    std::optional<float> probability;  ///< occupancy 0..1; empty: unknown
    std::uint32_t n_own = 0;           ///< scans with a point in it
    std::uint32_t n_occ = 0;           ///< keyframes that saw it occupied
    std::uint32_t n_free = 0;          ///< keyframes that saw through it
    std::uint32_t n_switch = 0;        ///< changes between the two, in order of time
    float free = 0.0F;                 ///< n_free in units of sure sights: a weak one is an eighth
    float expected_free = 0.0F;  ///< what `free` would be of a static voxel, in units of the same
    float score = 0.0F;          ///< in units of DynamicScore: above 0 something came or went
    std::size_t first = 0;       ///< Scan::index of the first with a point in it ...
    std::size_t last = 0;        ///< ... and of the last
    std::vector<std::size_t> free_keyframes;  ///< of a dynamic voxel, Scan::index of keyframes that
                                              ///< saw through it, ascending; up to 64 are asked
};

}  // namespace dynamic_filter
