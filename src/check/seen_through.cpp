// SPDX-License-Identifier: MIT
#include "check/seen_through.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace dynamic_filter::io {
namespace {

constexpr int kColumns = 360, kRows = 90;    // cells of a degree by a degree; up and down to 45 deg
constexpr float kNear = 2.0F, kFar = 40.0F;  // [m] of the points
constexpr float kClear = 0.7F, kClearShare = 0.03F;  // [m], share of the range

struct Cell {
    float range;
    int column, row;
};

std::optional<Cell> cell_of_direction(const Point& p) {
    const float range = p.norm();
    if (!(range > kNear)) return std::nullopt;
    constexpr double kPerRadian = 180.0 / std::numbers::pi;
    const double azimuth = std::atan2(p.y(), p.x()) * kPerRadian + 180.0,
                 elevation = std::asin(p.z() / range) * kPerRadian;
    const int row = static_cast<int>(std::floor(elevation)) + kRows / 2;
    if (row < 0 || row >= kRows) return std::nullopt;
    return Cell{range, static_cast<int>(azimuth) % kColumns, row};
}

}  // namespace

double seen_through(const Points& scan, const Points& points) {
    constexpr float kNothing = std::numeric_limits<float>::infinity();
    std::vector<float> nearest(kColumns * kRows, kNothing);
    const auto at = [](int column, int row) {
        return static_cast<std::size_t>(row * kColumns + (column + kColumns) % kColumns);
    };
    for (const Point& p : scan) {
        const auto cell = cell_of_direction(p);
        if (!cell) continue;
        float& range = nearest[at(cell->column, cell->row)];
        range = std::min(range, cell->range);
    }
    std::size_t hit = 0, passed = 0;
    for (const Point& p : points) {
        const auto cell = cell_of_direction(p);
        if (!cell || cell->range > kFar) continue;
        const float here = nearest[at(cell->column, cell->row)];
        if (here == kNothing) continue;
        // Edges: the nearest of the cells around, as beams beside it may have gone on.
        float least = here;
        for (int dx = -1; dx <= 1; ++dx) {
            for (int dy = -1; dy <= 1; ++dy) {
                const int row = cell->row + dy;
                if (row < 0 || row >= kRows) continue;
                least = std::min(least, nearest[at(cell->column + dx, row)]);
            }
        }
        const float clear = kClear + kClearShare * cell->range;
        if (least > cell->range + clear) {
            ++passed;
        } else if (std::abs(here - cell->range) < clear) {
            ++hit;
        }
    }
    return hit + passed == 0 ? 0.0
                             : static_cast<double>(passed) / static_cast<double>(hit + passed);
}

}  // namespace dynamic_filter::io
