// SPDX-License-Identifier: MIT
/// The seam between DynamicFilter and the methods: what a method has to be able to do. Poses,
/// points and voxels are in the map frame here.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/geometry/map_points.hpp"
#include "dynamic_filter/geometry/voxel_index.hpp"
#include "dynamic_filter/map_contents.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "dynamic_filter/types.hpp"
#include "dynamic_filter/verdict.hpp"

namespace dynamic_filter {

/// A scan, and which voxels its points lie in.
struct LocatedScan {
    MapPoints in_map;
    PointVoxels voxels;  ///< kNoVoxel: not measured, or in no voxel of the map
};

/// A voxel, and how surely it is occupied.
struct VoxelOccupancy {
    std::uint32_t voxel = kNoVoxel;
    float probability = 0.0F;  ///< 0..1
};

/// What an occupancy means; empty: unknown.
inline Label label_of(std::optional<float> probability, double threshold) {
    if (!probability) return Label::unknown;
    return *probability >= static_cast<float>(threshold) ? Label::static_ : Label::dynamic;
}

/// One way to tell what moves. Single caller, but see judges_each_scan(); const members may run in
/// several threads while no other runs.
class FilterMethod {
public:
    FilterMethod() = default;
    FilterMethod(const FilterMethod&) = delete;
    FilterMethod& operator=(const FilterMethod&) = delete;
    virtual ~FilterMethod() = default;

    /// Takes a scan, `T_world_sensor` being relative to the map.
    virtual Judged judge(Scan scan) = 0;
    /// True: every scan is judged at once, what judge() leaves must be integrated before the next
    /// scan is judged, and settle() says something. False: scans are judged window by window, and
    /// one thread may judge while another integrates.
    [[nodiscard]] virtual bool judges_each_scan() const = 0;
    /// Decides every voxel; returns the instant verdicts still due. Called once.
    virtual std::vector<Verdict> finish() = 0;

    /// The final verdict on a scan, after finish(): fills what is known into `verdict`, which is
    /// all unknown and parallel to the scan.
    virtual void decide(const LocatedScan& scan, Verdict& verdict) const = 0;
    /// The same from the evidence so far; leaves the verdict unknown where nobody knows yet.
    virtual void settle(const LocatedScan& scan, Verdict& verdict) const = 0;

    /// Forgets what lies beyond `radius` [m] of a place, and the farthest until about `most` of
    /// what size() counts are left.
    virtual void keep_within(const Eigen::Vector3d& center, double radius, std::size_t most) = 0;
    /// Voxels of the map, or points of the submaps.
    [[nodiscard]] virtual std::size_t size() const = 0;

    /// The static voxels around a pose, from the evidence so far.
    virtual std::vector<VoxelOccupancy> local_map(const Pose& T_map_query,
                                                  std::optional<double> radius) = 0;
    /// Every static voxel, after finish().
    [[nodiscard]] virtual std::vector<VoxelOccupancy> static_map() const = 0;

    [[nodiscard]] virtual const VoxelIndex& voxels() const = 0;
    /// Of each of the voxels, after finish().
    [[nodiscard]] virtual std::vector<VoxelHistory> histories(
        std::span<const std::uint32_t> voxels) const = 0;
    /// What there is, but for the number of voxels.
    [[nodiscard]] virtual MapContents contents() const = 0;
    [[nodiscard]] virtual StageTimes times() const = 0;
};

}  // namespace dynamic_filter
