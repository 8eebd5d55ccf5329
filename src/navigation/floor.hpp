// SPDX-License-Identifier: MIT
/// The floor that a robot reaches from the path of the sensor, without climbing.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "dynamic_filter/types.hpp"
#include "navigation/columns.hpp"

namespace dynamic_filter::app {

/// What the robot is.
struct Robot {
    float height = 1.5F;  ///< [m] what is higher above the floor does not touch it
    float step = 0.1F;    ///< [m] what it may climb from one cell to the next
};

/// The rectangle of cells that holds all surfaces.
struct Area {
    int x = 0, y = 0;           ///< of the first cell
    int width = 0, height = 0;  ///< cells
    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    [[nodiscard]] bool holds(int cx, int cy) const {
        return cx >= x && cy >= y && cx < x + width && cy < y + height;
    }
    [[nodiscard]] std::size_t index(int cx, int cy) const {
        return static_cast<std::size_t>(cy - y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(cx - x);
    }
};

/// Empty if there are no surfaces.
Area area_of(const std::vector<Surface>& surfaces);

/// Stands for "no floor" in place of a height.
constexpr float kNoFloor = std::numeric_limits<float>::quiet_NaN();

struct Floor {
    std::vector<float> height;         ///< [m] per cell of the area; kNoFloor where none is reached
    std::vector<std::uint8_t> driven;  ///< 1 per cell of the area that the path covers
    float sensor_height = 0.0F;        ///< [m] of the path above it
    std::vector<float> storeys;   ///< [m] heights between which the path changes, from the lowest
    std::size_t overlapping = 0;  ///< cells in which one reached floor lies above another
};

/// `path`: places of the sensor, in order. `storey`: which of the storeys to return, the first is
/// 1; 0: all, the higher one where two overlap. Throws ConfigError if there is no such storey.
Floor reached_floor(const std::vector<Surface>& surfaces, const Area& area, float cell,
                    const Points& path, const Robot& robot, int storey);

}  // namespace dynamic_filter::app
