// SPDX-License-Identifier: MIT
/// Surfaces by their cells, and what a robot needs to know of them.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "navigation/columns.hpp"
#include "navigation/floor.hpp"

namespace dynamic_filter::app {

inline int cell_at(float coordinate, float cell) {
    return static_cast<int>(std::floor(coordinate / cell));
}

class SurfaceMap {
public:
    /// `surfaces`, in the order of Columns::surfaces(), and `area` must outlive the map.
    SurfaceMap(const std::vector<Surface>& surfaces, const Area& area);

    /// Calls f(i) for each surface in the cell, from below, until f returns false.
    template <class F>
    void each(int x, int y, F&& f) const {
        if (!area_.holds(x, y)) return;
        for (std::size_t i = first_[area_.index(x, y)]; i < surfaces_.size(); ++i) {
            if (surfaces_[i].x != x || surfaces_[i].y != y || !f(i)) return;
        }
    }
    /// Whether something in the cell stands in the way of a robot on a floor of that height.
    [[nodiscard]] bool blocks(int x, int y, float floor, const Robot& robot) const;
    /// Whether the surface is a part of something flat, unlike what the filter missed of somebody.
    [[nodiscard]] bool is_flat(std::size_t i, float cell) const;
    /// Whether something lower is seen close by, so that the surface stands on that.
    [[nodiscard]] bool stands(std::size_t i, float cell, const Robot& robot) const;

    [[nodiscard]] const Surface& operator[](std::size_t i) const { return surfaces_[i]; }
    [[nodiscard]] std::size_t size() const { return surfaces_.size(); }

private:
    const std::vector<Surface>& surfaces_;
    const Area& area_;
    std::vector<std::uint32_t> first_;  // of each cell
};

}  // namespace dynamic_filter::app
