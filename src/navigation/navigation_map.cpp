// SPDX-License-Identifier: MIT
#include "navigation/navigation_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "dynamic_filter/error.hpp"
#include "navigation/surface_map.hpp"

namespace dynamic_filter::app {

namespace {

constexpr float kBeside = 2.0F;   // [m] from the floor: what stands farther off is not judged
constexpr float kBetween = 2.5F;  // [m] of unseen floor that beams above it may prove free
constexpr float kNarrow = 0.15F;  // [m] on each side, through which no robot fits
constexpr int kLeastBeams = 2;    // that pass above a cell without a point,
constexpr float kBlock = 0.2F;    // [m] in which beams high above the floor are counted together
constexpr float kLow = 0.3F;      // [m] so low that nothing can stand below them
constexpr float kBelly = 0.7F;    // [m] below which cars are closed, but not at their wheels
constexpr double kMostCells = 1e8;

constexpr std::array<std::array<int, 2>, 8> kNeighbors{
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

constexpr std::array<std::size_t, 4> kAxes{0, 1, 4, 5};  // of kNeighbors; the others are opposite

int cells_of(float length, float cell) { return std::max(1, static_cast<int>(length / cell)); }

/// The height of the nearest floor, for cells without one.
std::vector<float> floor_beside(const Floor& floor, const Area& area, int reach) {
    std::vector<float> heights = floor.height;
    std::vector<std::pair<int, int>> edge, next;
    for (int y = area.y; y < area.y + area.height; ++y) {
        for (int x = area.x; x < area.x + area.width; ++x) {
            if (!std::isnan(heights[area.index(x, y)])) edge.emplace_back(x, y);
        }
    }
    for (int step = 0; step < reach && !edge.empty(); ++step, edge.swap(next), next.clear()) {
        for (const auto& [x, y] : edge) {
            for (const auto& [dx, dy] : kNeighbors) {
                if (!area.holds(x + dx, y + dy)) continue;
                float& height = heights[area.index(x + dx, y + dy)];
                if (!std::isnan(height)) continue;
                height = heights[area.index(x, y)];
                next.emplace_back(x + dx, y + dy);
            }
        }
    }
    return heights;
}

/// What stands on the floor, or lies deeper than it. Returns 1 for each cell in which anything
/// does, be it a single point.
std::vector<std::uint8_t> mark_surfaces(NavigationMap& map, const std::vector<Surface>& surfaces,
                                        const std::vector<float>& beside, const Robot& robot) {
    std::vector<std::uint32_t> points(map.area.size());
    std::vector<std::uint8_t> doubtful(map.area.size());
    for (const Surface& s : surfaces) {
        const std::size_t i = map.area.index(s.x, s.y);
        const float floor = beside[i];
        const bool has_floor = !std::isnan(map.floor.height[i]);
        if (std::isnan(floor) || has_floor) continue;
        const bool stands = s.top > floor + robot.step && s.bottom < floor + robot.height;
        const bool is_deep = s.top < floor - robot.step && s.top > floor - robot.height;
        if (!stands && !is_deep) continue;
        doubtful[i] = 1;
        points[i] += s.points;
        if (points[i] >= 2) map.cells[i] = Passage::occupied;
    }
    return doubtful;
}

/// Floors side by side between which the robot cannot drive, such as a kerb whose both sides it
/// reaches.
void mark_ledges(NavigationMap& map, const Robot& robot) {
    const Area& area = map.area;
    for (int y = area.y; y < area.y + area.height; ++y) {
        for (int x = area.x; x < area.x + area.width; ++x) {
            const std::size_t i = area.index(x, y);
            for (const auto& [dx, dy] : kNeighbors) {
                if (!area.holds(x + dx, y + dy)) continue;
                const float other = map.floor.height[area.index(x + dx, y + dy)];
                // False where one of them is no floor.
                if (map.floor.height[i] - other > robot.step) map.cells[i] = Passage::occupied;
            }
        }
    }
}

/// Fills what is narrower than any robot, such as the place below a bench.
void close_narrow(NavigationMap& map, int reach) {
    const Area& area = map.area;
    const std::vector<Passage> before = map.cells;
    const auto is_occupied = [&](int x, int y, int dx, int dy) {
        for (int s = 1; s <= reach; ++s) {
            const int cx = x + s * dx, cy = y + s * dy;
            if (area.holds(cx, cy) && before[area.index(cx, cy)] == Passage::occupied) return true;
        }
        return false;
    };
    for (int y = area.y; y < area.y + area.height; ++y) {
        for (int x = area.x; x < area.x + area.width; ++x) {
            for (const std::size_t axis : kAxes) {
                const auto [dx, dy] = kNeighbors[axis];
                if (!is_occupied(x, y, dx, dy) || !is_occupied(x, y, -dx, -dy)) continue;
                map.cells[area.index(x, y)] = Passage::occupied;
                break;
            }
        }
    }
}

/// The height of the floor of cells that lie between two free ones, and hold no point.
std::vector<float> gaps(const NavigationMap& map, const std::vector<std::uint8_t>& doubtful,
                        const Robot& robot, int reach) {
    const Area& area = map.area;
    std::vector<float> heights(area.size(), kNoFloor);
    const auto end_of_gap = [&](int x, int y, int dx, int dy) {
        for (int s = 1; s <= reach; ++s) {
            const int cx = x + s * dx, cy = y + s * dy;
            if (!area.holds(cx, cy)) break;
            const std::size_t i = area.index(cx, cy);
            if (map.cells[i] == Passage::occupied) break;
            if (map.cells[i] == Passage::free) return map.floor.height[i];
        }
        return kNoFloor;
    };
    for (int y = area.y; y < area.y + area.height; ++y) {
        for (int x = area.x; x < area.x + area.width; ++x) {
            const std::size_t i = area.index(x, y);
            if (map.cells[i] != Passage::unknown || doubtful[i] != 0) continue;
            for (const std::size_t axis : kAxes) {
                const auto [dx, dy] = kNeighbors[axis];
                const float one = end_of_gap(x, y, dx, dy);
                if (std::isnan(one)) continue;
                const float two = end_of_gap(x, y, -dx, -dy);
                if (!(std::abs(one - two) <= robot.step)) continue;
                heights[i] = 0.5F * (one + two);
                break;
            }
        }
    }
    return heights;
}

/// Beams that pass above cells.
struct Passes {
    std::vector<std::uint8_t> low;   ///< per cell of a gap: close above its floor
    std::vector<std::uint8_t> high;  ///< per block of cells: from there up to the belly of a car
    int cells_of_block = 1, blocks_per_row = 0;
    [[nodiscard]] std::size_t block(const Area& area, int x, int y) const {
        const int row = (y - area.y) / cells_of_block, column = (x - area.x) / cells_of_block;
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(blocks_per_row) +
               static_cast<std::size_t>(column);
    }
};

void count(std::uint8_t& counter) {
    if (counter < UINT8_MAX) ++counter;
}

Passes passes_of(const NavigationMap& map, const std::vector<float>& gap, float cell,
                 const std::vector<Look>& looks) {
    const Area& area = map.area;
    Passes passes;
    passes.cells_of_block = cells_of(kBlock, cell);
    passes.blocks_per_row = area.width / passes.cells_of_block + 1;
    passes.low.resize(area.size());
    passes.high.resize(static_cast<std::size_t>(passes.blocks_per_row) *
                       static_cast<std::size_t>(area.height / passes.cells_of_block + 1));
    for (const Look& look : looks) {
        for (const Point& end : look.ends) {
            const Point way = end - look.from;
            const float length = way.head<2>().norm();
            if (length < 2.0F * cell) continue;
            const Point step = way * (cell / length);
            const auto steps =
                static_cast<int>(length / cell) - 1;  // not the cell in which it ends
            Point at = look.from + 0.5F * step;
            for (int s = 0; s < steps; ++s, at += step) {
                const int x = cell_at(at.x(), cell), y = cell_at(at.y(), cell);
                if (!area.holds(x, y)) continue;
                const std::size_t i = area.index(x, y);
                const bool is_gap = std::isnan(map.floor.height[i]);
                // Where there is neither, this is not a number, and no comparison is true.
                const float above = at.z() - (is_gap ? gap[i] : map.floor.height[i]);
                if (is_gap && above >= 0.0F && above <= kLow) count(passes.low[i]);
                if (above > kLow && above <= kBelly) count(passes.high[passes.block(area, x, y)]);
            }
        }
    }
    return passes;
}

/// Cells between free ones are free if beams passed close above them. Floor above which no beam
/// passed lies under a car whose top was not seen.
void ask_beams(NavigationMap& map, const std::vector<std::uint8_t>& doubtful, float cell,
               const std::vector<Look>& looks, const Robot& robot) {
    const std::vector<float> gap = gaps(map, doubtful, robot, cells_of(kBetween, cell));
    const Passes passes = passes_of(map, gap, cell, looks);
    const Area& area = map.area;
    for (int y = area.y; y < area.y + area.height; ++y) {
        for (int x = area.x; x < area.x + area.width; ++x) {
            const std::size_t i = area.index(x, y);
            if (passes.low[i] >= kLeastBeams) map.cells[i] = Passage::free;
            const bool is_open = passes.high[passes.block(area, x, y)] >= kLeastBeams;
            if (map.cells[i] == Passage::free && !is_open && map.floor.driven[i] == 0) {
                map.cells[i] = Passage::unknown;
            }
        }
    }
}

}  // namespace

NavigationMap navigation_map(const Columns& columns, const Points& path,
                             const std::vector<Look>& looks, const Robot& robot, int storey) {
    const std::vector<Surface> surfaces = columns.surfaces();
    const float cell = columns.cell();
    NavigationMap map;
    map.area = area_of(surfaces);
    const double cells = static_cast<double>(map.area.width) * map.area.height;
    if (cells > kMostCells) {
        throw ConfigError(
            fmt::format("the map would have {:.0f} million cells of {} m; give a larger --cell",
                        cells / 1e6, cell));
    }
    map.floor = reached_floor(surfaces, map.area, cell, path, robot, storey);
    map.cells.assign(map.area.size(), Passage::unknown);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
        if (!std::isnan(map.floor.height[i])) map.cells[i] = Passage::free;
    }
    const std::vector<float> beside = floor_beside(map.floor, map.area, cells_of(kBeside, cell));
    const std::vector<std::uint8_t> doubtful = mark_surfaces(map, surfaces, beside, robot);
    mark_ledges(map, robot);
    close_narrow(map, cells_of(kNarrow, cell));
    ask_beams(map, doubtful, cell, looks, robot);
    return map;
}

}  // namespace dynamic_filter::app
