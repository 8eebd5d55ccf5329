// SPDX-License-Identifier: MIT
/// Neighbours within a fixed radius, by a hash grid whose cells are as wide as the radius.
#pragma once

#include <tsl/robin_map.h>

#include <cstdint>
#include <span>
#include <vector>

#include "dynamic_filter/geometry/voxel.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

struct Neighbor {
    float distance_sq = 0.0F;  ///< [m^2]
    std::uint32_t index = 0;   ///< into the points the grid was built from
};

/// Immutable after construction; queries are thread-safe. Points that are not finite are left out.
class NeighborGrid {
public:
    /// Copies `points`. `radius` [m] is the largest radius queries may use.
    NeighborGrid(std::span<const Point> points, float radius);

    /// The (at most) k nearest points within the radius, nearest first; equal distances by index.
    void nearest(const Point& query, std::size_t k, std::vector<Neighbor>& out) const;

    /// True if some point lies within `distance` <= radius / 2 of the query.
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
    std::vector<Entry> sorted_;  // by cell, then by index
    tsl::robin_map<VoxelKey, Slice, VoxelHash> cells_;
};

}  // namespace dynamic_filter
