// SPDX-License-Identifier: MIT
/// Search for neighbors within a fixed radius, with a hash grid whose cells are as wide as the
/// radius.
#pragma once

#include <tsl/robin_map.h>

#include <cstdint>
#include <span>
#include <vector>

#include "dynamic_filter/types.hpp"
#include "geometry/voxel.hpp"

namespace dynamic_filter {

struct Neighbor {
    float distance_sq = 0.0F;  ///< [m^2]
    std::uint32_t index = 0;   ///< index into the points from which the grid was built
};

/// Immutable after construction; queries are thread-safe. Points that are not finite are left out.
class NeighborGrid {
public:
    /// Copies `points`. `radius` [m] is the largest radius queries may use.
    NeighborGrid(std::span<const Point> points, float radius);

    /// Returns the k nearest points (or fewer) within the radius, nearest first. Points at equal
    /// distance are ordered by index.
    void nearest(const Point& query, std::size_t k, std::vector<Neighbor>& out) const;

    /// True if at least one point lies within `distance` of the query. `distance` must be at most
    /// radius / 2.
    [[nodiscard]] bool any_within(const Point& query, float distance) const;

    [[nodiscard]] const Point& point(std::uint32_t index) const { return points_[index]; }
    [[nodiscard]] std::size_t size() const { return sorted_.size(); }

private:
    struct Slice {
        std::uint32_t begin = 0, end = 0;
    };
    [[nodiscard]] Slice slice(const Cell& cell) const;

    struct Entry {
        Point point;
        std::uint32_t index;
    };
    float radius_, inverse_cell_;
    std::vector<Point> points_;
    std::vector<Entry> sorted_;  // sorted by cell, then by index
    tsl::robin_map<VoxelKey, Slice, VoxelHash> cells_;
};

}  // namespace dynamic_filter
