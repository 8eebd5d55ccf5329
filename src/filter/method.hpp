// SPDX-License-Identifier: MIT
/// The interface between DynamicFilter and its methods: the functions that every method implements.
/// Poses, points and voxels are in the map frame here.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "dynamic_filter/types.hpp"
#include "geometry/map_points.hpp"
#include "geometry/voxel_index.hpp"

namespace dynamic_filter {

/// A scan in the map frame, with the voxel of each of its points.
struct LocatedScan {
    MapPoints in_map;
    PointVoxels
        voxels;  ///< parallel to the points; kNoVoxel: not measured, or in no voxel of the map
};

/// A voxel and its probability of being occupied.
struct VoxelOccupancy {
    std::uint32_t voxel = kNoVoxel;
    float probability = 0.0F;  ///< 0..1
};

/// Label of a voxel with this occupancy; an empty probability gives `unknown`.
inline Label label_of(std::optional<float> probability, double threshold) {
    if (!probability) return Label::unknown;
    return *probability >= static_cast<float>(threshold) ? Label::static_ : Label::dynamic;
}

/// A method to detect moving objects. Single caller, except as judges_each_scan() says. Const
/// members may run in several threads while no other member runs.
class FilterMethod {
public:
    FilterMethod() = default;
    FilterMethod(const FilterMethod&) = delete;
    FilterMethod& operator=(const FilterMethod&) = delete;
    virtual ~FilterMethod() = default;

    /// Takes a scan. Its `T_world_sensor` is relative to the map frame here.
    virtual Judged judge(Scan scan) = 0;
    /// True: judge() gives a verdict on every scan at once, the work that it leaves must be
    /// integrated before the next scan is judged, and settle() gives verdicts. False: scans are
    /// judged window by window, and one thread may judge while another integrates.
    [[nodiscard]] virtual bool judges_each_scan() const = 0;
    /// The next scan is the first one of another drive through the same world, perhaps by another
    /// sensor and with other stamps. The evidence stays. The method "submaps" knows no drives.
    virtual void begin_drive() {}
    /// Lets a scan of an earlier drive (counted from 0) observe what was found after that drive.
    virtual void look_again(std::size_t /*drive*/, const Scan& /*scan*/) {}
    /// Decides every voxel, and returns the instant verdicts that were not returned before. Call it
    /// once.
    virtual std::vector<Verdict> finish() = 0;

    /// The final verdict on a scan, after finish(). Writes the labels and probabilities that are
    /// known into `verdict`, which must be all unknown and parallel to the scan.
    virtual void decide(const LocatedScan& scan, Verdict& verdict) const = 0;
    /// The same from the evidence so far. Leaves labels unknown where there is no evidence yet.
    virtual void settle(const LocatedScan& scan, Verdict& verdict) const = 0;

    /// Removes everything farther than `radius` [m] from `center`. Then removes the farthest parts
    /// until size() is about `most`.
    virtual void keep_within(const Eigen::Vector3d& center, double radius, std::size_t most) = 0;
    /// Number of voxels of the map, or of points of the submaps.
    [[nodiscard]] virtual std::size_t size() const = 0;

    /// Returns the static voxels around a pose, from the evidence so far.
    virtual std::vector<VoxelOccupancy> local_map(const Pose& T_map_query,
                                                  std::optional<double> radius) = 0;
    /// Returns every static voxel, after finish().
    [[nodiscard]] virtual std::vector<VoxelOccupancy> static_map() const = 0;

    [[nodiscard]] virtual const VoxelIndex& voxels() const = 0;
    /// Returns the history of each of the voxels, after finish().
    [[nodiscard]] virtual std::vector<VoxelHistory> histories(
        std::span<const std::uint32_t> voxels) const = 0;
    /// Contents of the method, without the number of voxels.
    [[nodiscard]] virtual MapContents contents() const = 0;
    [[nodiscard]] virtual StageTimes times() const = 0;
};

}  // namespace dynamic_filter
