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
#include "filter/displacement.hpp"
#include "filter/evidence_grid.hpp"

namespace dynamic_filter {

/// Tracks clusters over scans. A person who stops at a kerb, or a car that waits in a queue, may
/// stand there until the recording ends; no beam then shows that the place is free. But earlier
/// scans saw the object move there. So clusters are linked to tracks by overlap. A track is that of
/// a moving object
/// - once its clusters were dynamic in several scans and it has gone some distance; or
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
/// Source: docs/how-it-works.md, "Objects". Single caller. Memory: 8 bytes for each voxel of the
/// tracks in sight, and 5 KB for each track.
class Objects {
public:
    explicit Objects(const ScansConfig::Instances& config) : config_(config) {}

    /// Uses the scan that was last added to the grid. `labels` are its instant verdicts; points of
    /// moving objects become dynamic there. Scans that follow sooner than `every` are skipped.
    void update(const Scan& scan, const PointVoxels& voxels, EvidenceGrid& grid, Labels& labels);

    /// Renumbers the voxels: only those with the old numbers `kept` remain, in that order.
    void keep(std::span<const std::uint32_t> kept);

private:
    using Id = std::uint32_t;
    /// State of a track when it was last seen.
    struct Seen {
        double stamp = 0.0;  // [s]
        Point center = Point::Zero();
        std::size_t voxels = 0;
        float length = 0.0F;  // [m] longest side of its bounding box
    };
    struct Track {
        std::uint32_t start = 0;             // number of its first scan
        std::uint32_t arrival = 0;           // scan in which it came, if that was seen
        double arrived_scans = 0.0;          // in which it stood where it came to, weighted
        Point first_center = Point::Zero();  // center in its first scan
        Point velocity = Point::Zero();      // [m/s]
        Seen seen;
        int dynamic_scans = 0;
        FollowedSurface surface{};
        bool is_displaced = false;      // its surface moved
        std::uint32_t there_since = 0;  // scan since when the voxels of its first scan are occupied
        // Of a moving object: points that were first seen in this scan or later are its points.
        std::optional<std::uint32_t> moving_from{};
        // Per voxel: number of scans; kept until the track is that of a moving object.
        tsl::robin_map<std::uint32_t, std::uint32_t> history{};
    };
    struct Cluster {
        std::vector<std::uint32_t> voxels;  // ascending
        Point center = Point::Zero();
        float length = 0.0F;      // [m]
        std::size_t dynamic = 0;  // number of voxels
        std::size_t came = 0;     // of those that are dynamic or were filled
        // The scans in which the voxels were filled that were seen free before.
        std::vector<std::uint32_t> filled{};
        // A moving object was last seen there; from this scan on it was known to be one.
        std::optional<std::uint32_t> after_moving{};
        std::optional<Id> track{};
    };
    [[nodiscard]] std::vector<Cluster> describe(const Clusters& clusters, const PointVoxels& voxels,
                                                const EvidenceGrid& grid,
                                                const Labels& labels) const;
    void match(std::vector<Cluster>& clusters, const EvidenceGrid& grid, double stamp) const;
    [[nodiscard]] bool fits(const Track& track, const Cluster& cluster, double stamp) const;
    void note_arrival(Track& track, const Cluster& cluster) const;
    [[nodiscard]] std::optional<std::uint32_t> moving_from(const Track& track) const;
    void follow(Cluster& cluster, EvidenceGrid& grid, double stamp, std::uint32_t scans);
    void begin(Cluster& cluster, const EvidenceGrid& grid);
    void find_displaced(const Scan& scan, const Clusters& found,
                        const std::vector<Cluster>& clusters, EvidenceGrid& grid);
    void use_history(Track& track, EvidenceGrid& grid) const;
    void forget(double stamp);

    ScansConfig::Instances config_;
    std::map<Id, Track> tracks_;
    Id next_ = 0;
    struct Place {
        Id track;
        double stamp;
    };
    tsl::robin_map<VoxelKey, Place, VoxelHash> last_there_;  // per block of voxels
    std::optional<double> last_stamp_, last_look_;
    std::optional<Eigen::Vector3d> origin_;  // [m, world frame] of the compared surfaces
    std::uint32_t last_scan_ = 0;
};

}  // namespace dynamic_filter
