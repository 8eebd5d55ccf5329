// SPDX-License-Identifier: MIT
/// The voxels of the map with their evidence.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/types.hpp"
#include "filter/archive.hpp"
#include "filter/evidence.hpp"
#include "geometry/map_points.hpp"
#include "geometry/voxel_index.hpp"
#include "geometry/voxel_neighbors.hpp"

namespace dynamic_filter {

/// A part of the map: the voxels whose cell lies in [low, high) along x and y, at any height.
struct CellBounds {
    Eigen::Vector2i low, high;  ///< multiples of 4, so that blocks are not cut

    [[nodiscard]] bool contain(VoxelKey key) const {
        const Cell cell = unpack(key);
        return cell.x() >= low.x() && cell.x() < high.x() && cell.y() >= low.y() &&
               cell.y() < high.y();
    }
};

/// Stores voxels in blocks of 4 x 4 x 4. The position of a voxel is the centroid of its points in
/// the first scan that has points in it. So the voxel can be judged at once, and its position never
/// changes. Single caller; const members may run in several threads, and so may record() and
/// update_score() for different voxels. Points are in the map frame.
class EvidenceGrid {
public:
    /// With `bounds`, points outside of them have no voxel.
    EvidenceGrid(float voxel_size, const ScansConfig::Evidence& config,
                 const std::optional<CellBounds>& bounds = {})
        : bounds_(bounds),
          voxel_size_(voxel_size),
          longest_run_(static_cast<unsigned>(config.longest_run)),
          score_(config) {}

    /// Adds the points of the next scan to their voxels, and records the scan as an owner of these
    /// voxels. New voxels are numbered after the existing ones, so that voxels of one block are
    /// consecutive. Returns the voxel of each point.
    PointVoxels add_points(const Scan& scan);
    /// Adds the observation of a keyframe, see evidence.hpp. `newest`: the keyframe is the newest
    /// scan. Returns true if update_score() would change the score.
    bool record(std::uint32_t voxel, Sight sight, unsigned weight, bool newest);
    void update_score(std::uint32_t voxel);
    /// See without_observations() in evidence.hpp.
    void forget_observations(std::uint32_t voxel) {
        states_[voxel].evidence = without_observations(states_[voxel].evidence);
    }
    /// As record(), for a keyframe of long ago: a return at the place counts as a point in it.
    void record_again(std::uint32_t voxel, Sight sight) {
        const bool hit = sight == Sight::occupied;
        dynamic_filter::record(states_[voxel].evidence, {sight, 1, hit}, longest_run_);
    }

    /// True if as many keyframes in a row as count saw the same, occupied or free: another one that
    /// sees the voxel occupied again does not change its score.
    [[nodiscard]] bool is_sure(std::uint32_t voxel) const {
        return states_[voxel].evidence.run >= longest_run_;
    }
    /// The voxels of a block that are noted as sure, as in VoxelIndex::each_in_block(). The caller
    /// notes them; different blocks may be noted in several threads.
    [[nodiscard]] std::uint64_t sure_in(std::uint32_t block) const { return sure_[block]; }
    void set_sure_in(std::uint32_t block, std::uint64_t places) { sure_[block] = places; }

    /// See record_moved() in evidence.hpp.
    void record_moved(std::uint32_t voxel, unsigned scans) {
        dynamic_filter::record_moved(states_[voxel].evidence, scans);
    }

    /// Removes the blocks whose center lies beyond `radius` [m] of a place, then the farthest
    /// blocks until about `most_voxels` are left. Voxels get new numbers. Returns the old number of
    /// each voxel that is left.
    std::vector<std::uint32_t> keep_within(const Point& center, float radius,
                                           std::size_t most_voxels);

    /// The voxels whose centroid lies within `radius` [m] of a place.
    [[nodiscard]] std::vector<std::uint32_t> within(const Point& center, float radius) const;
    /// The blocks in which the newest scan has points (`touched`), or those in which it has none.
    [[nodiscard]] std::vector<std::uint32_t> blocks_touched(bool touched) const;
    /// Blocks of the voxels from number `first` on, ascending.
    [[nodiscard]] std::vector<std::uint32_t> blocks_from(std::uint32_t first) const;
    [[nodiscard]] Point middle_of(std::uint32_t block) const {
        return (voxels_.corner(block).cast<float>().array() + 2.0F) * voxel_size_;
    }

    /// Writes the voxels, or reads them into a grid without any.
    void archive(Archive& archive);

    [[nodiscard]] float voxel_size() const { return voxel_size_; }  ///< [m]
    [[nodiscard]] const VoxelIndex& voxels() const { return voxels_; }
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(voxels_.size()); }
    [[nodiscard]] std::uint32_t scans() const { return scans_; }  ///< number of scans added so far
    [[nodiscard]] const VoxelNeighbors& neighbors() const { return neighbors_; }

    /// See DynamicScore::expected_free().
    [[nodiscard]] float expected_free(const Evidence& e) const { return score_.expected_free(e); }

    /// All data of a voxel in one cache line, because voxels are accessed in any order.
    struct alignas(64) State {
        Point centroid = Point::Zero();
        /// DynamicScore, 0 while unknown; stored because neighbors read it often.
        float score = 0.0F;
        Evidence evidence;
    };
    [[nodiscard]] const State& operator[](std::uint32_t voxel) const { return states_[voxel]; }

private:
    void own(std::span<const VoxelKey> keys, std::span<std::uint32_t> voxels);
    void number_by_block(std::size_t known, PointVoxels& voxels_of_points);
    void find_centroids(std::size_t known, const MapPoints& in_map,
                        const PointVoxels& voxels_of_points);

    std::optional<CellBounds> bounds_;
    float voxel_size_;
    unsigned longest_run_;
    DynamicScore score_;
    VoxelIndex voxels_;
    VoxelNeighbors neighbors_;
    std::vector<std::uint32_t> touched_;  // per block: the newest scan with a point in it
    std::vector<std::uint64_t> sure_;     // per block: see sure_in()
    std::vector<State> states_;           // per voxel
    std::uint32_t scans_ = 0;
};

}  // namespace dynamic_filter
