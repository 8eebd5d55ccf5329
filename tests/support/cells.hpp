// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geometry/voxel.hpp"
#include "support/random.hpp"

namespace dynamic_filter::test {

/// Cells of a cube around `corner`, a third of them.
inline std::vector<Cell> scattered(const Cell& corner, int width, std::uint64_t seed) {
    Random random(seed);
    std::vector<Cell> cells;
    for (int i = 0; i < width * width * width / 3; ++i) {
        const auto step = [&] {
            return static_cast<int>(random.below(static_cast<std::uint32_t>(width)));
        };
        const Cell cell = corner + Cell(step(), step(), step());
        if (fits(cell)) cells.push_back(cell);
    }
    return cells;
}

}  // namespace dynamic_filter::test
