// SPDX-License-Identifier: MIT
/// Maps from above: static points by height, removed points in red.
#pragma once

#include <tsl/robin_map.h>

#include "dynamic_filter/geometry/voxel.hpp"
#include "dynamic_filter/io/png.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::app {

/// Collects points into square columns; memory goes with the area seen. Single caller.
class TopView {
public:
    /// Points in any one frame with z up. Unknown counts as kept.
    void add(const Points& points, const Labels& labels);

    /// `removed` true: all points, the removed ones in red; false: the kept points only.
    /// The same area either way: where 99.8 % of the points are.
    [[nodiscard]] io::Image draw(bool removed) const;

private:
    struct Column {
        float highest_kept = -1e9F;
        std::uint32_t kept = 0, removed = 0;
    };
    tsl::robin_map<VoxelKey, Column, VoxelHash> columns_;
};

}  // namespace dynamic_filter::app
