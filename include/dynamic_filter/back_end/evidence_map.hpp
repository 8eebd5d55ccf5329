// SPDX-License-Identifier: MIT
/// The occupancy grid with scans as observers: incremental, and symmetric in time.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/back_end/evidence.hpp"
#include "dynamic_filter/config.hpp"
#include "dynamic_filter/geometry/voxel_index.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// A scan that observes.
struct Observer {
    BeamImage image;
    Eigen::Isometry3f T_sensor_map = Eigen::Isometry3f::Identity();
};

/// The voxel of each point of a scan; kNoVoxel for points that were not measured or lie too far
/// out.
using PointVoxels = std::vector<std::uint32_t>;

/// Every voxel is asked about once by every observer: a new keyframe looks at the voxels known so
/// far, a new voxel asks the keyframes kept so far. So nothing is computed twice, and the result is
/// that of asking all keyframes about all voxels, but for keyframes no longer kept.
///
/// A voxel stands for the centroid of its points in the first scan that has any there, so it can be
/// judged at once, and never moves. Single caller; const members may run in several threads. Poses
/// and points are in the map frame.
class EvidenceMap {
public:
    explicit EvidenceMap(const Config& config);

    /// Takes a scan whose `T_world_sensor` is relative to the map. Cost: points, plus blocks of
    /// voxels, plus the voxels of those within sight, plus new voxels times keyframes kept.
    PointVoxels insert(const Scan& scan, StageTimes& times);

    /// Occupancy 0..1 of voxels: their own evidence, and that of the voxels within two cells, those
    /// above all that were there when they were there. Empty: unknown. In parallel.
    [[nodiscard]] std::vector<std::optional<float>> probabilities(
        std::span<const std::uint32_t> voxels) const;

    /// Keyframes that have observed.
    [[nodiscard]] std::size_t observers() const { return all_observers_; }
    [[nodiscard]] const VoxelIndex& voxels() const { return voxels_; }
    [[nodiscard]] const Evidence& evidence(std::uint32_t voxel) const { return evidence_[voxel]; }
    [[nodiscard]] const Point& centroid(std::uint32_t voxel) const { return centroids_[voxel]; }
    /// Read off the first scan that has enough points; empty before it.
    [[nodiscard]] const std::optional<BeamPattern>& beams() const { return beams_; }

private:
    PointVoxels add_points(const Scan& scan);
    bool add_observer(const Scan& scan);
    void check_known(std::size_t known);
    void check_new(std::size_t known);
    struct Neighborhood;
    struct Glance;
    void look_at(std::span<const std::uint32_t> blocks, Glance& glance, const Observer& observer);

    float voxel_size_;
    Config::Submap keyframes_;
    std::size_t most_observers_;
    SightMargins margins_;
    std::optional<BeamPattern> beams_;
    std::optional<Scan> last_keyframe_;  // pose and stamp only
    std::deque<Observer> observers_;
    std::size_t all_observers_ = 0;
    std::uint32_t scans_ = 0;

    VoxelIndex voxels_;
    Points centroids_;  // by voxel, as the evidence is
    std::vector<Evidence> evidence_;
    std::vector<float>
        transience_;  // of the evidence; neighbours ask far more often than it changes
};

}  // namespace dynamic_filter
