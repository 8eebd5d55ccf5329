// SPDX-License-Identifier: MIT
/// The occupancy grid with scans as observers: incremental, and symmetric in time.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/back_end/evidence.hpp"
#include "dynamic_filter/back_end/line_of_sight.hpp"
#include "dynamic_filter/config.hpp"
#include "dynamic_filter/geometry/beam_image.hpp"
#include "dynamic_filter/geometry/map_points.hpp"
#include "dynamic_filter/geometry/voxel_index.hpp"
#include "dynamic_filter/geometry/voxel_neighbors.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// A scan that observes.
struct Observer {
    BeamImage image;
    Eigen::Isometry3f T_sensor_map = Eigen::Isometry3f::Identity();
    float reach = 0.0F;     ///< [m] how far it looks
    std::size_t index = 0;  ///< Scan::index
};

/// The voxel of each point of a scan; kNoVoxel for points that were not measured or lie too far
/// out.
using PointVoxels = std::vector<std::uint32_t>;

/// Every voxel is asked about once by every observer: a new keyframe looks at the voxels known so
/// far, a new voxel asks the keyframes kept so far: the newest all, of the older ones a selection
/// that stands for them. So nothing is computed twice, and the result is nearly (with few
/// keyframes: exactly) that of asking all keyframes about all voxels in their reach.
///
/// A voxel stands for the centroid of its points in the first scan that has any there, so it can be
/// judged at once, and never moves. Single caller; const members may run in several threads. Poses
/// and points are in the map frame.
class EvidenceMap {
public:
    explicit EvidenceMap(const Config& config);

    /// Takes a scan whose `T_world_sensor` is relative to the map, as far as its own points are
    /// concerned. Cost: points, plus new voxels times keyframes asked.
    PointVoxels insert(const Scan& scan, StageTimes& times);

    /// Lets that scan look at the rest of the map, where it has no points. Call it once after each
    /// insert(). Cost: blocks of voxels, plus the voxels of those within sight.
    void look_at_rest(StageTimes& times);

    /// Forgets blocks of voxels beyond `radius` [m] of a place, and the farthest ones until at most
    /// `most_voxels` are left (about). Voxels get new numbers. Returns the old number of each.
    std::vector<std::uint32_t> keep_within(const Point& center, float radius,
                                           std::size_t most_voxels);

    /// Voxels whose centroid lies within `radius` [m] of a place.
    [[nodiscard]] std::vector<std::uint32_t> within(const Point& center, float radius) const;

    /// Occupancy 0..1 of voxels: their own evidence, and that of the voxels within two cells, those
    /// above all that were there when they were there. Empty: unknown. In parallel.
    [[nodiscard]] std::vector<std::optional<float>> probabilities(
        std::span<const std::uint32_t> voxels) const;

    /// For each of the voxels, the keyframes kept so far (their Scan::index, ascending) that see
    /// through it. A voxel asked older ones at the time, and may have counted one for several. In
    /// parallel; cost: blocks of those voxels times keyframes.
    [[nodiscard]] std::vector<std::vector<std::size_t>> seen_through(
        std::span<const std::uint32_t> voxels) const;

    /// The keyframes kept so far, by their Scan::index.
    [[nodiscard]] std::vector<std::size_t> keyframes() const;
    /// Scan::index of an owner (Evidence::first_owner, last_owner).
    [[nodiscard]] std::size_t index_of_owner(std::uint32_t owner) const { return indices_[owner]; }

    /// Scans that were taken in, without those that measured nothing.
    [[nodiscard]] std::uint32_t scans() const { return scans_; }
    /// Keyframes that have observed.
    [[nodiscard]] std::size_t observers() const { return all_observers_; }
    [[nodiscard]] const VoxelIndex& voxels() const { return voxels_; }
    /// See VoxelNeighbors.
    template <class Use>
    void each_within(int cells, std::uint32_t voxel, const Use& use) const {
        neighbors_.each_within(voxels_, cells, voxel, use);
    }
    [[nodiscard]] const Evidence& evidence(std::uint32_t voxel) const {
        return states_[voxel].evidence;
    }
    /// Its transience.
    [[nodiscard]] float opinion(std::uint32_t voxel) const { return states_[voxel].opinion; }
    [[nodiscard]] const Point& centroid(std::uint32_t voxel) const {
        return states_[voxel].centroid;
    }
    /// Read off the first scan that has enough points; empty before it.
    [[nodiscard]] const std::optional<BeamPattern>& beams() const { return beams_; }

private:
    PointVoxels add_points(const Scan& scan);
    class OwnVoxels;
    std::uint32_t own(VoxelKey key);
    void number_by_block(std::size_t known, PointVoxels& voxels_of_points);
    void find_centroids(std::size_t known, const MapPoints& in_map,
                        const PointVoxels& voxels_of_points);
    bool add_observer(const Scan& scan);
    enum class Where { touched, elsewhere };
    void check_known(std::size_t known, Where where);
    struct Asked {
        const Observer* observer;
        unsigned weight;
    };
    [[nodiscard]] std::vector<Asked> asked_by_new() const;
    void check_new(std::size_t known);
    [[nodiscard]] Point middle_of(std::uint32_t block) const;
    struct Neighborhood;
    struct Glance;
    void see(std::span<const std::uint32_t> blocks, Glance& glance, const Observer& observer) const;
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
    std::vector<std::size_t> indices_;  // by order of the scans
    double last_far_look_ = 0.0;        // [s]
    std::size_t rest_ = 0;  // voxels below this number, but those in blocks touched, are to look at

    VoxelIndex voxels_;
    VoxelNeighbors neighbors_;
    std::vector<std::uint32_t> touched_;  // by block: the newest scan with a point in it
    struct State {
        Point centroid = Point::Zero();
        float opinion = 0.0F;  // its transience; neighbours ask far more often than it changes
        Evidence evidence;
    };
    std::vector<State> states_;  // by voxel
};

}  // namespace dynamic_filter
