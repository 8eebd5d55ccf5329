// SPDX-License-Identifier: MIT
/// @file
/// Results of the filter: verdicts on scans, static voxels, and the evidence behind them.
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

/// The verdict on one scan. An *instant* verdict uses the evidence up to this scan; a *settled* one
/// also uses a given number of later scans; the *final* one uses the whole recording.
struct Verdict {
    std::size_t index = 0;  ///< Scan::index
    Labels labels;          ///< one per point
    /// One per point: probability 0..1 that its voxel is occupied, or 0 where the label is unknown.
    /// A point that stands on a static surface may be dynamic although its voxel is probably
    /// occupied. In instant verdicts: in steps of 1/255, as of the moment when the label of the
    /// voxel was decided; empty with the methods "submaps" and "removert".
    std::vector<float> probability;
    /// Only in final verdicts with `map.time` = latest, otherwise empty: true for dynamic points
    /// that were still in their place when the place was last seen.
    std::vector<bool> stays{};
    /// Only in instant verdicts, and only if the filter estimated or refined the pose: the pose and
    /// the motion of the sensor. The world frame is then the sensor frame of the first scan, or the
    /// frame of the given poses.
    std::optional<Tracked> tracked{};
};

/// A verdict with all points unknown and all probabilities 0.
inline Verdict unknown_verdict(const Scan& scan) {
    return {scan.index, Labels(scan.points.size(), Label::unknown),
            std::vector<float>(scan.points.size(), 0.0F)};
}

/// Result of judging a scan.
struct Judged {
    std::vector<Verdict> verdicts;  ///< instant verdicts, see DynamicFilter::push()
    /// The work that can wait until the verdicts are delivered; empty if there is none. Call it
    /// once, while the filter exists.
    std::function<void()> integrate;
};

/// A voxel of a static map.
struct StaticVoxel {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m] world frame
    float probability = 0.0F;                          ///< occupancy 0..1
    std::uint32_t voxel = 0;  ///< its number, as DynamicFilter::voxels_of() gives it
};

/// The observations of a voxel, to explain the verdict on a point in it. With the method "submaps",
/// only the probability is known; all other values are zero.
struct VoxelHistory {
    std::optional<float> probability;  ///< 0..1 of being occupied; empty: unknown
    std::uint32_t n_own = 0;           ///< scans with a point in it
    std::uint32_t n_occ = 0;           ///< keyframes that saw the voxel occupied
    std::uint32_t n_free = 0;          ///< keyframes that saw through the voxel
    std::uint32_t n_switch = 0;        ///< changes between occupied and free, in order of time
    /// The count n_free in units of sure observations; a weak observation counts an eighth.
    float free = 0.0F;
    /// Value of `free` expected of a static voxel with these counts, in units of sure observations.
    float expected_free = 0.0F;
    float score = 0.0F;     ///< in units of DynamicScore; above 0 something came or went
    std::size_t first = 0;  ///< Scan::index of the first scan with a point in the voxel
    std::size_t last = 0;   ///< Scan::index of the last scan with a point in the voxel
    /// Of a dynamic voxel: Scan::index of keyframes that saw through it, ascending. At most 64
    /// keyframes are checked for this list.
    std::vector<std::size_t> free_keyframes;
};

}  // namespace dynamic_filter
