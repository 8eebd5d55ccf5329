// SPDX-License-Identifier: MIT
/// Tracks of objects over scans, and which cluster of the next scan continues which track.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <tsl/robin_map.h>
#include <Eigen/Geometry>

#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/types.hpp"
#include "filter/displacement.hpp"

namespace dynamic_filter {

using TrackId = std::uint32_t;

/// An object over several scans. Lengths [m] in the map frame; scans are numbered in their order.
struct Track {
    /// How it was last seen.
    struct Seen {
        double stamp = 0.0;  ///< [s]
        Point center = Point::Zero();
        Eigen::AlignedBox3f box{};
        Points places{};  ///< centroids of its voxels
    };
    std::uint32_t start = 0;             ///< its first scan
    std::uint32_t arrival = 0;           ///< scan in which it came, if that was seen
    double arrived_scans = 0.0;          ///< in which it stood where it came to, weighted
    Point first_center = Point::Zero();  ///< center in its first scan
    Point velocity = Point::Zero();      ///< [m/s]
    int views = 0;                       ///< number of scans that saw it
    Seen seen{};
    int dynamic_scans = 0;  ///< in which it was dynamic
    /// The latest scans in a row that each saw that it had left its last place, and where it was
    /// before them.
    int leaving_scans = 0;
    Point left = Point::Zero();
    FollowedSurface surface{};
    bool is_displaced = false;      ///< its surface moved
    std::uint32_t there_since = 0;  ///< scan since when the voxels of its first scan are occupied
    /// Of a moving object: points that were first seen in this scan or later are its points.
    std::optional<std::uint32_t> moving_from{};
    /// Per voxel: number of scans; kept until the track is that of a moving object.
    tsl::robin_map<std::uint32_t, std::uint32_t> history{};

    /// True if it moves, as far as is known.
    [[nodiscard]] bool seems_to_move() const {
        return moving_from || dynamic_scans > 0 || leaving_scans > 0;
    }
};

/// A cluster of one scan; see find_clusters().
struct Cluster {
    std::vector<std::uint32_t> voxels{};  ///< ascending
    Point center = Point::Zero();
    Eigen::AlignedBox3f box{};  ///< [m] of the centroids of its voxels
    std::size_t dynamic = 0;    ///< number of dynamic voxels
    std::size_t came = 0;       ///< number of voxels that are dynamic or were filled
    /// The scans in which the voxels were filled that were seen free before.
    std::vector<std::uint32_t> filled{};
    /// Number of its voxels in places where these tracks were last seen.
    std::map<TrackId, std::size_t> shared{};
    std::optional<TrackId> track{};

    [[nodiscard]] float length() const { return box.sizes().maxCoeff(); }  ///< [m] longest side
};

/// [m] How far the object should have moved since it was last seen. One that was seen once is taken
/// to move as the sensor does, because what moves otherwise is found more easily.
Point expected_step(const Track& track, double stamp, const Point& sensor_velocity);

/// Gives the clusters the tracks that they continue; `shared` must be known. A cluster gets at most
/// one track, and a track goes to at most one cluster. Three rules, one after the other:
/// - An object that moves is the cluster that is nearest to where it should be by now. What lies on
///   places of objects at rest is left to these.
/// - Otherwise, a cluster continues the track whose places it shares most.
/// - An object that was seen once and that moves as the sensor does shares no place with itself. It
///   is the cluster that is nearest to where it should be then.
/// In each case, size and center must be similar: else, the track of an object would go on with
/// another object that it touches. `sensor_velocity` [m/s]. Source: docs/how-it-works.md,
/// "Instances".
void match(std::vector<Cluster>& clusters, const std::map<TrackId, Track>& tracks, double stamp,
           const Point& sensor_velocity, const ScansConfig::Instances& config);

}  // namespace dynamic_filter
