// SPDX-License-Identifier: MIT
/// A map in two dimensions for navigation: where a robot may drive, where it may not, and where
/// nobody looked.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "navigation/columns.hpp"
#include "navigation/floor.hpp"

namespace dynamic_filter::app {

enum class Passage : std::uint8_t { unknown, free, occupied };

/// Beams of one scan: from the sensor to where each ends.
struct Look {
    Point from;
    Points ends;
};

struct NavigationMap {
    Area area;
    std::vector<Passage> cells;  ///< of the area, by Area::index()
    Floor floor;

    [[nodiscard]] bool has_free_cell() const {
        return std::find(cells.begin(), cells.end(), Passage::free) != cells.end();
    }
};

/// A cell is free if a floor was seen there that the robot reaches, and nothing static stands on
/// it; or if it lies between such cells, and beams passed above it. It is occupied if something
/// static is between step and height of the robot above the floor next to it, or if the floor ends
/// there in a ledge. All else is unknown. Throws ConfigError as reached_floor(), and if the area
/// has more than 100 million cells.
NavigationMap navigation_map(const Columns& columns, const Points& path,
                             const std::vector<Look>& looks, const Robot& robot, int storey);

}  // namespace dynamic_filter::app
