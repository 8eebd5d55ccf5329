// SPDX-License-Identifier: MIT
/// @file
/// The whole pipeline, scan by scan (Fig. 2).
///
/// - Units: [m], [s], probabilities 0..1.
/// - Frames: points in the sensor frame, poses T_world_sensor, maps in the world frame.
/// - Shapes: verdicts are parallel to the points of their scan.
/// - Ownership: scans are moved in and not kept (method "submaps": kept until their window is
///   processed); results belong to the caller.
/// - Threads: single caller; const members may run in several threads while no other member runs.
/// - Errors: ConfigError from the constructor; Error from push() after finish(); std::bad_alloc,
///   after which the filter can only be destroyed or assigned to. Poses are not checked here;
///   OnlineFilter checks them. Before finish(), verdict() returns all unknown and static_map() is
///   empty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/config.hpp"
#include "dynamic_filter/map_contents.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "dynamic_filter/types.hpp"
#include "dynamic_filter/verdict.hpp"

namespace dynamic_filter {

/// A part of the world to which a filter is limited, so that a large area can be filtered piece by
/// piece. Points outside of it stay unknown, but their beams still show what is free inside.
struct Region {
    /// Origin of the map frame [m, world frame], a multiple of the voxel size along each axis.
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    /// [m] x and y relative to the origin, multiples of 4 voxels; any height.
    Eigen::AlignedBox2d bounds;
};

/// Removes moving objects from a recording. Usage: push() every scan, call finish(), then call
/// verdict() for any scan. Single caller, but see judge(); const members may run in several threads
/// while no other member runs. The same scans and settings give bit-identical results for any
/// number of threads.
///
/// Scans are not kept. Memory with the method "scans": about 92 bytes per voxel, 28 more after
/// finish(), and six bytes per pixel of each of the newest `scans.max_keyframes` keyframes. Memory
/// with the method "submaps": one window of scans, and the thinned submaps.
class DynamicFilter {
public:
    /// Throws ConfigError if a setting is wrong.
    explicit DynamicFilter(const Config& config);
    /// The same for a part of the world. Throws ConfigError also if the method is not "scans".
    DynamicFilter(const Config& config, const Region& region);
    /// The moved-from filter can only be destroyed or assigned to.
    DynamicFilter(DynamicFilter&&) noexcept;
    DynamicFilter& operator=(DynamicFilter&&) noexcept;  ///< see the move constructor
    ~DynamicFilter();

    /// Call it between two drives through the same world. The next scan may be of another sensor,
    /// and its stamp may be of any time. What one drive saw and a later one saw through is dynamic.
    /// The method "submaps" knows no drives.
    void begin_drive();
    /// Lets a scan of an earlier drive (counted from 0) observe what only later drives found, so
    /// that what came is dynamic, too. Call it after the last push() and before finish(), for the
    /// scans of each drive but the last in their order.
    void look_again(std::size_t drive, Scan scan);

    /// Takes a scan with points in the sensor frame. Stamps must not decrease within a drive.
    /// Method "scans": returns the instant verdict on this scan. Method "submaps": if the scan
    /// opens a new window, the previous window is processed and the instant verdicts on its scans
    /// are returned; otherwise nothing is returned.
    std::vector<Verdict> push(Scan scan);

    /// Does the work of push() in two steps: it returns the verdicts, and a function for the work
    /// that can wait until the verdicts are delivered. Every such function must be called, in
    /// order. If judges_each_scan() is true, call it before the next scan is judged; otherwise one
    /// thread may judge while another one integrates.
    Judged judge(Scan scan);
    /// True for the method "scans": every scan is judged at once, and settled() gives verdicts.
    [[nodiscard]] bool judges_each_scan() const;

    /// Decides every voxel. Method "submaps": processes the last window, returns its verdicts, and
    /// merges the local maps of all submap poses (Sec. III-D). A second call does nothing.
    std::vector<Verdict> finish();

    /// The final verdict on a scan that was pushed, after finish(). Points that are not measured,
    /// or that are too far away for a voxel key, are unknown.
    [[nodiscard]] Verdict verdict(const Scan& scan) const;
    /// The same, and the voxel of each point, as voxels_of() gives it.
    [[nodiscard]] Verdict verdict(const Scan& scan, std::vector<std::uint32_t>& voxels) const;

    /// The verdict on a scan from the evidence so far. Only the final verdict separates points that
    /// stand on a static surface from that surface. With the method "submaps", all points are
    /// unknown.
    [[nodiscard]] Verdict settled(const Scan& scan) const;

    /// The voxel of each point of a scan; UINT32_MAX: no voxel.
    [[nodiscard]] std::vector<std::uint32_t> voxels_of(const Scan& scan) const;
    /// The history of each of the voxels, after finish(). Voxels that were seen through at least
    /// once cost as much time as it took to observe them.
    [[nodiscard]] std::vector<VoxelHistory> histories(std::span<const std::uint32_t> voxels) const;

    /// Removes the map beyond `radius` [m] of a pose. Then removes its farthest parts until size()
    /// is about `most`. Voxels are removed in blocks of 4 x 4 x 4. Submaps are removed as a whole;
    /// the limit `most` always leaves one submap. Removed places are unknown.
    void keep_within(const Pose& T_world_center, double radius, std::size_t most);
    /// Number of voxels of the map, or of points of its submaps.
    [[nodiscard]] std::size_t size() const;

    /// The static local map at any pose (Sec. III-C), from the scans or the closed submaps so far.
    /// Method "scans": the static voxels within `radius` [m] of the pose; the default is
    /// `map.search_radius`. Method "submaps": the static voxels of the submaps within
    /// `map.search_radius`; `radius` has no effect.
    std::vector<StaticVoxel> local_static_map(const Pose& T_world_query,
                                              std::optional<double> radius = {});

    /// The merged map, after finish() (Sec. III-D): all static voxels.
    [[nodiscard]] std::vector<StaticVoxel> static_map() const;

    [[nodiscard]] StageTimes times() const;      ///< [s] time of each stage so far
    [[nodiscard]] MapContents contents() const;  ///< sizes and counts so far

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dynamic_filter
