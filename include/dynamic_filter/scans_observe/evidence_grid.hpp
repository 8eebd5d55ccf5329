// SPDX-License-Identifier: MIT
/// The voxels of the map, and what is known of each.
#pragma once

#include <span>
#include <vector>

#include "dynamic_filter/geometry/map_points.hpp"
#include "dynamic_filter/geometry/voxel_index.hpp"
#include "dynamic_filter/geometry/voxel_neighbors.hpp"
#include "dynamic_filter/scans_observe/evidence.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Voxels in blocks of 4 x 4 x 4. A voxel stands for the centroid of its points in the first scan
/// that has any there, so it can be judged at once, and never moves. Single caller; const members
/// may run in several threads, and record() and update_score() too, for different voxels. Points
/// are in the map frame.
class EvidenceGrid {
public:
    EvidenceGrid(float voxel_size, const ScansConfig::Evidence& config)
        : voxel_size_(voxel_size),
          longest_run_(static_cast<unsigned>(config.longest_run)),
          score_(config) {}

    /// Puts the points of the next scan into voxels, which it owns from now on. New voxels come
    /// after the others, those of a block together.
    PointVoxels add_points(const Scan& scan);
    /// Takes in what a keyframe saw of the voxel, see evidence.hpp; `newest`: it is the newest
    /// scan. True if update_score() would change the score.
    bool record(std::uint32_t voxel, Sight sight, unsigned weight, bool newest);
    void update_score(std::uint32_t voxel);

    /// See evidence.hpp.
    void record_moved(std::uint32_t voxel, unsigned scans) {
        dynamic_filter::record_moved(states_[voxel].evidence, scans);
    }

    /// Forgets blocks whose middle lies beyond `radius` [m] of a place, and the farthest ones until
    /// about `most_voxels` are left. Voxels get new numbers. Returns the old number of each.
    std::vector<std::uint32_t> keep_within(const Point& center, float radius,
                                           std::size_t most_voxels);

    /// Voxels whose centroid lies within `radius` [m] of a place.
    [[nodiscard]] std::vector<std::uint32_t> within(const Point& center, float radius) const;
    /// Blocks in which the newest scan has points, or those in which it has none.
    [[nodiscard]] std::vector<std::uint32_t> blocks_touched(bool touched) const;
    /// Blocks of the voxels from `first` on, ascending.
    [[nodiscard]] std::vector<std::uint32_t> blocks_from(std::uint32_t first) const;
    [[nodiscard]] Point middle_of(std::uint32_t block) const {
        return (voxels_.corner(block).cast<float>().array() + 2.0F) * voxel_size_;
    }

    [[nodiscard]] float voxel_size() const { return voxel_size_; }  ///< [m]
    [[nodiscard]] const VoxelIndex& voxels() const { return voxels_; }
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(voxels_.size()); }
    [[nodiscard]] std::uint32_t scans() const { return scans_; }  ///< with points, taken in so far
    [[nodiscard]] const VoxelNeighbors& neighbors() const { return neighbors_; }

    /// See DynamicScore.
    [[nodiscard]] float expected_free(const Evidence& e) const { return score_.expected_free(e); }

    /// All of it in one line of cache: voxels are asked in any order.
    struct alignas(64) State {
        Point centroid = Point::Zero();
        float score = 0.0F;  ///< DynamicScore, 0 while unknown; kept, as neighbours ask often
        Evidence evidence;
    };
    [[nodiscard]] const State& operator[](std::uint32_t voxel) const { return states_[voxel]; }

private:
    void own(std::span<const VoxelKey> keys, std::span<std::uint32_t> voxels);
    void number_by_block(std::size_t known, PointVoxels& voxels_of_points);
    void find_centroids(std::size_t known, const MapPoints& in_map,
                        const PointVoxels& voxels_of_points);

    float voxel_size_;
    unsigned longest_run_;
    DynamicScore score_;
    VoxelIndex voxels_;
    VoxelNeighbors neighbors_;
    std::vector<std::uint32_t> touched_;  // by block: the newest scan with a point in it
    std::vector<State> states_;           // by voxel
    std::uint32_t scans_ = 0;
};

}  // namespace dynamic_filter
