// SPDX-License-Identifier: MIT
/// Static points in columns of cells, as seen from above: what stands where, and how high.
#pragma once

#include <tsl/robin_map.h>

#include <cstdint>
#include <vector>

#include "geometry/voxel.hpp"

namespace dynamic_filter::app {

/// Points of one column that lie one above the other without a gap.
struct Surface {
    int x = 0, y = 0;                 ///< the cell, floor(coordinate / size of a cell)
    float bottom = 0.0F, top = 0.0F;  ///< [m]
    std::uint32_t points = 0;
};

class Columns {
public:
    /// `cell`: width of a cell [m].
    explicit Columns(float cell) : cell_(cell) {}

    /// `point` in a frame whose z points up, within 50 km of its origin.
    /// It stands for so many points.
    void add(const Point& point, std::uint32_t count = 1);
    /// In the order of x, y and height.
    [[nodiscard]] std::vector<Surface> surfaces() const;
    [[nodiscard]] float cell() const { return cell_; }

private:
    struct Bin {
        std::uint32_t points = 0;
        float sum = 0.0F;  // of the heights within the bin
    };
    float cell_;
    tsl::robin_map<VoxelKey, Bin, VoxelHash> bins_;
};

}  // namespace dynamic_filter::app
