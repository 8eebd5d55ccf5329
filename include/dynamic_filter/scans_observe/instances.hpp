// SPDX-License-Identifier: MIT
/// What moves as one is judged as one: clusters of scans, tied together over time.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <tsl/robin_map.h>

#include "dynamic_filter/scans_observe/clusters.hpp"
#include "dynamic_filter/scans_observe/evidence_grid.hpp"

namespace dynamic_filter {

/// A person who stops at a kerb, or a car at its place in a queue, is at rest where no beam passes
/// before the recording ends or the sensor is gone; but it was seen to come. So clusters of scans
/// are tied to tracks, by overlap. A track moves once its clusters were dynamic in several scans
/// and have gone some way. From then on, and back to where it began, its points are those of
/// something that moves: every voxel counts in how many scans that was so (Evidence::moved), and
/// occupancy_of() takes it from there.
///
/// What was there before the track came is not part of it: the bench beside a person, the parked
/// car beside one that passes. A voxel counts only if it was seen empty, or not at all, before.
///
/// Single caller. Memory: 8 bytes for each voxel of the tracks in sight.
class Instances {
public:
    explicit Instances(const ScansConfig::Instances& config) : config_(config) {}

    /// Takes in the scan that the grid took in last; `labels` are the instant verdicts on it, and
    /// points of what moves become dynamic. Scans that follow sooner than `every` are passed
    /// over.
    void update(const Scan& scan, const PointVoxels& voxels, EvidenceGrid& grid, Labels& labels);

    /// Voxels got new numbers: those of the old numbers `kept` are left, in that order.
    void keep(std::span<const std::uint32_t> kept);

private:
    using Id = std::uint32_t;
    /// What a track was when seen last.
    struct Seen {
        double stamp = 0.0;  // [s]
        Point center = Point::Zero();
        std::size_t voxels = 0;
    };
    struct Track {
        std::uint32_t start = 0;             // order of its first scan
        Point first_center = Point::Zero();  // there
        Point velocity = Point::Zero();      // [m/s]
        Seen seen;
        int dynamic_scans = 0;
        bool moves = false;
        tsl::robin_map<std::uint32_t, std::uint32_t> history{};  // scans, by voxel; until it moves
    };
    struct Cluster {
        std::vector<std::uint32_t> voxels;  // ascending
        Point center = Point::Zero();
        std::size_t dynamic = 0;  // voxels
        std::optional<Id> track{};
    };
    [[nodiscard]] std::vector<Cluster> describe(const Clusters& clusters, const PointVoxels& voxels,
                                                const EvidenceGrid& grid,
                                                const Labels& labels) const;
    void match(std::vector<Cluster>& clusters, const EvidenceGrid& grid, double stamp) const;
    [[nodiscard]] bool fits(const Track& track, const Cluster& cluster, double stamp) const;
    void follow(Cluster& cluster, EvidenceGrid& grid, double stamp, std::uint32_t scans);
    void forget(double stamp);

    ScansConfig::Instances config_;
    std::map<Id, Track> tracks_;
    Id next_ = 0;
    struct Place {
        Id track;
        double stamp;
    };
    tsl::robin_map<VoxelKey, Place, VoxelHash> last_there_;  // by block of voxels
    std::optional<double> last_stamp_;
    std::uint32_t last_scan_ = 0;
};

}  // namespace dynamic_filter
