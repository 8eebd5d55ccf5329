// SPDX-License-Identifier: MIT
/// Objects: clusters of scans are tracked over time, so that a moving object is judged as a
/// whole.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <tsl/robin_map.h>

#include "filter/clusters.hpp"
#include "filter/evidence_map.hpp"
#include "filter/tracks.hpp"

namespace dynamic_filter {

/// Tracks clusters over scans. A person who stops at a kerb, or a car that waits in a queue, may
/// stand there until the recording ends; no beam then shows that the place is free. But earlier
/// scans saw the object move there. So clusters are linked to tracks (tracks.hpp). A track is that
/// of a moving object
/// - once its clusters were dynamic in several scans and it has gone some distance; or
/// - once two scans in a row saw empty the place where it was just before, and it has gone some
///   distance in one direction. This finds what drives ahead of the sensor: it covers all places
///   before it gets there, so they are never seen free; but it leaves them; or
/// - once it came: in several scans, about half of the voxels of its clusters were dynamic, or seen
///   free first and occupied ever since. Few of them may be sure by themselves: together they are.
///   If another track of a moving object ended there, one such scan is enough; or
/// - once its surface moved steadily. This finds what moves so slowly that its middle part is never
///   seen to come or go.
/// A track also is that of a moving object if most of its first voxels are: it is a part of such an
/// object that comes into view again.
/// All its points, from the first scan of the track on, or from when it came on, are then points of
/// a moving object. Each voxel counts the scans in which it held such points (Evidence::moved);
/// occupancy_of() uses this count.
///
/// Static objects that touch a track must stay static: the bench beside a person, the parked car
/// beside a car that passes. So a voxel counts only if it was seen empty, or was not seen at all,
/// before the track came.
///
/// Of several sensors, each has objects of its own.
///
/// Source: docs/how-it-works.md, "Objects". Single caller. Memory: 4 bytes for each voxel of the
/// map, 8 bytes for each voxel of the tracks in sight, and 5 KB for each track.
class Objects {
public:
    explicit Objects(const ScansConfig::Instances& config) : config_(config) {}

    /// The clusters of the scan that was last added to the grid; empty if it follows sooner than
    /// `every`, because then it is skipped.
    [[nodiscard]] std::optional<Clusters> clusters_in(const Scan& scan, const PointVoxels& voxels);
    /// Follows the clusters of that scan. `labels` are its instant verdicts; points of moving
    /// objects become dynamic there.
    void update(const Scan& scan, const PointVoxels& voxels, const Clusters& clusters,
                EvidenceMap& map, Labels& labels);

    /// Renumbers the voxels: only those with the old numbers `kept` remain, in that order.
    void keep(std::span<const std::uint32_t> kept);

private:
    [[nodiscard]] std::vector<Cluster> describe(const Clusters& clusters, const PointVoxels& voxels,
                                                const EvidenceGrid& grid, const Labels& labels);
    [[nodiscard]] Cluster describe(std::vector<std::uint64_t>& members,
                                   const EvidenceGrid& grid) const;
    [[nodiscard]] std::optional<std::uint32_t> after_moving(const Cluster& cluster) const;
    void note_arrival(Track& track, const Cluster& cluster) const;
    [[nodiscard]] bool has_moved(const Track& track) const;
    [[nodiscard]] std::optional<std::uint32_t> moving_from(const Track& track) const;
    void follow(Cluster& cluster, const Keyframe* seen_by, EvidenceMap& map, double stamp,
                std::uint32_t scans);
    void begin(Cluster& cluster, const EvidenceGrid& grid);
    void find_displaced(const Scan& scan, const Clusters& found,
                        const std::vector<Cluster>& clusters, EvidenceGrid& grid);
    void occupy(VoxelKey block, TrackId track);
    void use_history(Track& track, EvidenceGrid& grid) const;
    void forget(double stamp);

    ScansConfig::Instances config_;
    std::map<TrackId, Track> tracks_;
    TrackId next_ = 0;
    struct Place {
        TrackId track;
        double stamp;
    };
    tsl::robin_map<VoxelKey, Place, VoxelHash> last_there_;  // per block of voxels
    std::vector<std::uint32_t> in_cluster_;  // per voxel; kNoCluster between two updates
    std::optional<double> last_stamp_, last_look_;
    Point last_sensor_ = Point::Zero();      // [m] place of the sensor in the last scan
    std::optional<Eigen::Vector3d> origin_;  // [m, world frame] of the compared surfaces
    std::uint32_t last_scan_ = 0;
    std::uint32_t scans_ = 0;  // since the last update, with the newest
};

}  // namespace dynamic_filter
