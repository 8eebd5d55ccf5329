// SPDX-License-Identifier: MIT
/// @file
/// The whole pipeline, scan by scan (Fig. 2).
///
/// - Units: [m], [s], probabilities 0..1.
/// - Frames: points in the sensor's, poses T_world_sensor, maps in the world's.
/// - Shapes: verdicts are parallel to the points of their scan.
/// - Ownership: scans are moved in, and not kept (where submaps observe: until their window is
///   processed); results are the caller's.
/// - Threads: single caller; const members may run in several threads while no other runs.
/// - Errors: ConfigError from the constructor; Error from push() after finish(); std::bad_alloc,
///   after which the filter can only be destroyed or assigned to. Poses are taken as they come: see
///   OnlineFilter, which checks them. Before finish(), verdict() and static_map() know nothing.
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

/// Usage: push() every scan, finish(), then verdict() of any scan. Single caller, but see judge();
/// const members may run in several threads while no other runs. Same scans and config give the
/// same bits for any number of threads. Scans are not kept. Memory: scans observe: about 92 bytes a
/// voxel, 28 more after finish(), and six a pixel of the newest `scans.max_keyframes` keyframes;
/// submaps observe: one window of scans and the thinned submaps.
class DynamicFilter {
public:
    /// Throws ConfigError.
    explicit DynamicFilter(const Config& config);
    /// The other one can only be destroyed or assigned to.
    DynamicFilter(DynamicFilter&&) noexcept;
    DynamicFilter& operator=(DynamicFilter&&) noexcept;  ///< as above
    ~DynamicFilter();

    /// Takes a scan, points in the sensor frame, stamps in order. Scans observe: returns its
    /// instant verdict. Submaps observe: when the scan opens a new window, the one before is
    /// processed and its scans' instant verdicts are returned; otherwise nothing.
    std::vector<Verdict> push(Scan scan);

    /// push() in two steps: the verdicts, and what can wait until they are delivered. What each
    /// judge() leaves must be integrated, in order. Where judges_each_scan(), that must be done
    /// before the next scan is judged; otherwise one thread may judge while another integrates.
    Judged judge(Scan scan);
    /// True where scans observe: every scan is judged at once, and settled() knows something.
    [[nodiscard]] bool judges_each_scan() const;

    /// Decides every voxel. Submaps observe: processes the last window (its verdicts are returned)
    /// and merges the local maps of all submap poses. Again: does nothing.
    std::vector<Verdict> finish();

    /// The final verdict on a scan that was pushed, after finish(). Unknown where nothing can be
    /// said: not measured, or beyond the reach of a voxel's key.
    [[nodiscard]] Verdict verdict(const Scan& scan) const;

    /// The verdict on a scan from the evidence so far; what stands on a static surface is told from
    /// it by the final verdict only. Where submaps observe, all is unknown.
    [[nodiscard]] Verdict settled(const Scan& scan) const;

    /// The voxel of each point of a scan; UINT32_MAX: none.
    [[nodiscard]] std::vector<std::uint32_t> voxels_of(const Scan& scan) const;
    /// After finish(): of each of the voxels. Costs as much as it cost to observe those of them
    /// that were ever seen through.
    [[nodiscard]] std::vector<VoxelHistory> histories(std::span<const std::uint32_t> voxels) const;

    /// Forgets the map beyond `radius` [m] of a pose, and the farthest of it until its size() is
    /// about `most`: voxels go in blocks of 4 x 4 x 4, submaps as a whole, of which `most` spares
    /// one. What is forgotten is unknown.
    void keep_within(const Pose& T_world_center, double radius, std::size_t most);
    /// Voxels of the map, or points of its submaps.
    [[nodiscard]] std::size_t size() const;

    /// The static local map at any pose (Sec. III-C), from the scans or the closed submaps so far:
    /// the static voxels within `map.search_radius`, or of the submaps within it. Where scans
    /// observe, `radius` [m] may take its place.
    std::vector<StaticVoxel> local_static_map(const Pose& T_world_query,
                                              std::optional<double> radius = {});

    /// The merged map, after finish() (Sec. III-D): every static voxel.
    [[nodiscard]] std::vector<StaticVoxel> static_map() const;

    [[nodiscard]] StageTimes times() const;      ///< [s] of each stage so far
    [[nodiscard]] MapContents contents() const;  ///< what there is

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dynamic_filter
