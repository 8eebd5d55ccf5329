// SPDX-License-Identifier: MIT
#include "export/navigation/floor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {

namespace {

constexpr float kBridged = 2.5F;     // [m] between rings of a sensor, over which the floor goes on
constexpr float kPathWidth = 0.25F;  // [m] on each side, that the robot covered for sure
constexpr float kHighestSensor = 4.0F;  // [m] above the floor
constexpr float kStoreyHeight = 2.0F;   // [m] at least
// So few points above a floor of many are no obstacle, but what the filter missed of somebody.
constexpr float kFewPoints = 5.0F, kFewShare = 0.03F;
constexpr float kSteepest = 0.3F;       // of a ramp,
constexpr float kBridgedSlope = 0.08F;  // and of one over which the floor is not seen
constexpr float kNoise = 0.03F;         // [m] of the height of a floor
constexpr std::uint32_t kNone = UINT32_MAX;

/// Surfaces by their cells.
class Map {
public:
    Map(const std::vector<Surface>& surfaces, const Area& area)
        : surfaces_(surfaces), area_(area), first_(area.size(), kNone) {
        for (std::size_t i = surfaces.size(); i-- > 0;) {
            first_[area.index(surfaces[i].x, surfaces[i].y)] = static_cast<std::uint32_t>(i);
        }
    }
    /// Calls f(i) for each surface in the cell, from below, until f returns false.
    template <class F>
    void each(int x, int y, F&& f) const {
        if (!area_.holds(x, y)) return;
        for (std::size_t i = first_[area_.index(x, y)]; i < surfaces_.size(); ++i) {
            if (surfaces_[i].x != x || surfaces_[i].y != y || !f(i)) return;
        }
    }
    /// Whether something in the cell stands in the way of a robot on a floor of that height.
    [[nodiscard]] bool blocks(int x, int y, float floor, const Robot& robot) const {
        bool blocked = false;
        float points_of_floor = 0.0F;
        each(x, y, [&](std::size_t i) {
            const Surface& s = surfaces_[i];
            const auto points = static_cast<float>(s.points);
            if (s.top <= floor + robot.step) {
                points_of_floor = points;
                return true;
            }
            const bool is_stray =
                points < 2.0F || points < std::min(kFewPoints, kFewShare * points_of_floor);
            blocked = s.bottom < floor + robot.height && !is_stray;
            return !blocked && s.bottom < floor + robot.height;
        });
        return blocked;
    }
    /// Whether the surface is a part of something flat, unlike what the filter missed of somebody.
    [[nodiscard]] bool is_flat(std::size_t i) const {
        constexpr int kReach = 2, kLeast = 3;  // cells
        constexpr float kThick = 0.05F;        // [m]
        const Surface& s = surfaces_[i];
        int beside = 0;
        for (int y = s.y - kReach; y <= s.y + kReach; ++y) {
            for (int x = s.x - kReach; x <= s.x + kReach; ++x) {
                if (x == s.x && y == s.y) continue;
                each(x, y, [&](std::size_t k) {
                    const bool is_level = std::abs(surfaces_[k].top - s.top) <= kThick;
                    beside += is_level ? 1 : 0;
                    return !is_level;
                });
                if (beside >= kLeast) return true;
            }
        }
        return false;
    }
    /// Whether something lower is seen close by, so that the surface stands on that.
    [[nodiscard]] bool stands(std::size_t i, float cell, const Robot& robot) const {
        constexpr float kClose = 0.5F;  // [m]
        const Surface& s = surfaces_[i];
        const auto reach = static_cast<int>(kClose / cell);
        bool found = false;
        for (int y = s.y - reach; y <= s.y + reach && !found; ++y) {
            for (int x = s.x - reach; x <= s.x + reach && !found; ++x) {
                each(x, y, [&](std::size_t k) {
                    found = surfaces_[k].top < s.top - robot.step &&
                            surfaces_[k].top > s.top - robot.height;
                    return !found && surfaces_[k].top < s.top;
                });
            }
        }
        return found;
    }
    [[nodiscard]] const Surface& operator[](std::size_t i) const { return surfaces_[i]; }
    [[nodiscard]] std::size_t size() const { return surfaces_.size(); }

private:
    const std::vector<Surface>& surfaces_;
    const Area& area_;
    std::vector<std::uint32_t> first_;
};

int cell_at(float coordinate, float cell) {
    return static_cast<int>(std::floor(coordinate / cell));
}

/// Calls f(x, y) for the cells whose middle is within `radius` of a place.
template <class F>
void around(const Point& place, float cell, float radius, F&& f) {
    const auto reach = static_cast<int>(std::ceil(radius / cell));
    const int cx = cell_at(place.x(), cell), cy = cell_at(place.y(), cell);
    for (int y = cy - reach; y <= cy + reach; ++y) {
        for (int x = cx - reach; x <= cx + reach; ++x) {
            const float dx = (static_cast<float>(x) + 0.5F) * cell - place.x();
            const float dy = (static_cast<float>(y) + 0.5F) * cell - place.y();
            if (dx * dx + dy * dy <= radius * radius) f(x, y);
        }
    }
}

/// The height above the surfaces below it that most of them have.
float height_of_sensor(const Map& map, const Points& path, float cell, float radius) {
    constexpr float kHeightBin = 0.05F;
    std::vector<std::size_t> counts(static_cast<std::size_t>(kHighestSensor / kHeightBin) + 2);
    for (const Point& place : path) {
        around(place, cell, radius, [&](int x, int y) {
            map.each(x, y, [&](std::size_t i) {
                const float below = place.z() - map[i].top;
                if (below > 0.0F && below < kHighestSensor) {
                    ++counts[static_cast<std::size_t>(below / kHeightBin)];
                }
                return true;
            });
        });
    }
    std::size_t best = 1, most = 0;
    for (std::size_t i = 1; i + 1 < counts.size(); ++i) {
        const std::size_t n = counts[i - 1] + counts[i] + counts[i + 1];
        if (n > most) best = i, most = n;
    }
    return most == 0 ? 0.0F : (static_cast<float>(best) + 0.5F) * kHeightBin;
}

/// Cells on a line from (0, 0), without it.
using Way = std::vector<std::pair<int, int>>;

std::vector<Way> ways(int cells) {
    constexpr int kWays = 32;
    std::vector<Way> all;
    for (int w = 0; w < kWays; ++w) {
        const double angle = 2.0 * std::numbers::pi * w / kWays;
        Way way;
        for (int s = 1; s <= cells; ++s) {
            way.emplace_back(static_cast<int>(std::lround(s * std::cos(angle))),
                             static_cast<int>(std::lround(s * std::sin(angle))));
        }
        all.push_back(std::move(way));
    }
    return all;
}

/// Grows over surfaces that a robot can drive from one to the next. Each surface must be within a
/// step of the level from which it is reached, which rises no faster than a ramp: points on the
/// face of a box must not become a stair.
class Growth {
public:
    Growth(const Map& map, float cell, const Robot& robot)
        : map_(map),
          cell_(cell),
          robot_(robot),
          ways_(ways(static_cast<int>(kBridged / cell))),
          reached_(map.size(), 0),
          level_(map.size()) {}

    /// Begins around a place of the path; `below` is the floor that must be there. Returns whether
    /// there is any.
    bool begin(const Surface& below, const Point& place, float radius) {
        bool found = false;
        around(place, cell_, radius, [&](int x, int y) {
            map_.each(x, y, [&](std::size_t i) {
                if (std::abs(map_[i].top - below.top) > robot_.step) return true;
                if (reached_[i] == 0 && is_open(below, map_[i])) seed(i, below.top, 0.0F);
                found |= reached_[i] != 0;
                return true;
            });
        });
        return found;
    }
    std::vector<std::uint8_t> run() {
        while (!open_.empty()) {
            const std::size_t i = open_.front();
            open_.pop_front();
            grow(map_[i], level_[i]);
        }
        return std::move(reached_);
    }

private:
    /// `level`: from which surface i is reached, at a distance [m].
    void seed(std::size_t i, float level, float distance) {
        if (reached_[i] != 0 || !map_.is_flat(i) ||
            map_.blocks(map_[i].x, map_[i].y, map_[i].top, robot_)) {
            return;
        }
        reached_[i] = 1;
        const float rise = kSteepest * distance;
        level_[i] = level + std::clamp(map_[i].top - level, -rise, rise);
        open_.push_back(i);
    }
    /// Looks around for floor that goes on from here, as far as the next one or an obstacle.
    void grow(const Surface& from, float level) {
        for (const auto& way : ways_) {
            for (const auto& [dx, dy] : way) {
                const int x = from.x + dx, y = from.y + dy;
                const float away =
                    cell_ * std::hypot(static_cast<float>(dx), static_cast<float>(dy));
                // A step is only known between cells that touch.
                const bool touches = std::max(std::abs(dx), std::abs(dy)) == 1;
                const float most =
                    touches ? robot_.step : std::min(robot_.step, kNoise + kBridgedSlope * away);
                bool found = false;
                map_.each(x, y, [&](std::size_t i) {
                    found = std::abs(map_[i].top - level) <= most;
                    if (found && reached_[i] == 0 && (touches || !map_.stands(i, cell_, robot_))) {
                        seed(i, level, away);
                    }
                    return !found && map_[i].top < level;
                });
                if (found || map_.blocks(x, y, level, robot_)) break;
            }
        }
    }
    /// Whether nothing stands on the line between them.
    [[nodiscard]] bool is_open(const Surface& from, const Surface& to) const {
        const int steps = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));
        for (int s = 1; s < steps; ++s) {
            const float share = static_cast<float>(s) / static_cast<float>(steps);
            const auto at = [&](int a, int b) {
                return static_cast<int>(
                    std::lround(static_cast<float>(a) + share * static_cast<float>(b - a)));
            };
            const float floor = from.top + share * (to.top - from.top);
            if (map_.blocks(at(from.x, to.x), at(from.y, to.y), floor, robot_)) return false;
        }
        return true;
    }

    const Map& map_;
    float cell_;
    const Robot& robot_;
    std::vector<Way> ways_;
    std::vector<std::uint8_t> reached_;
    std::vector<float> level_;
    std::deque<std::size_t> open_;
};

/// Heights at which much of the path lies, a storey apart, from the lowest.
std::vector<float> storeys_of(const Points& path, float sensor_height) {
    constexpr float kLevelBin = 0.25F;
    constexpr double kLeastShare = 0.1;
    std::map<int, std::size_t> counts;
    for (const Point& place : path) {
        ++counts[static_cast<int>(std::floor((place.z() - sensor_height) / kLevelBin))];
    }
    std::vector<float> storeys;
    while (!counts.empty()) {
        const auto most = std::max_element(counts.begin(), counts.end(),
                                           [](auto& a, auto& b) { return a.second < b.second; });
        if (static_cast<double>(most->second) < kLeastShare * static_cast<double>(path.size()))
            break;
        const float height = (static_cast<float>(most->first) + 0.5F) * kLevelBin;
        storeys.push_back(height);
        std::erase_if(counts, [&](const auto& bin) {
            return std::abs((static_cast<float>(bin.first) + 0.5F) * kLevelBin - height) <
                   kStoreyHeight;
        });
    }
    std::sort(storeys.begin(), storeys.end());
    return storeys;
}

bool is_on(float height, const std::vector<float>& storeys, int storey) {
    if (storey == 0) return true;
    const auto nearest = std::min_element(storeys.begin(), storeys.end(), [&](float a, float b) {
        return std::abs(a - height) < std::abs(b - height);
    });
    return nearest - storeys.begin() + 1 == storey;
}

void require(int storey, const std::vector<float>& storeys) {
    if (storey <= static_cast<int>(storeys.size())) return;
    throw ConfigError(fmt::format(
        "--storey {}: the path of the sensor has {} storey{}, at {:.1f} m from the height at which "
        "the sensor begins",
        storey, storeys.size(), storeys.size() == 1 ? "" : "s", fmt::join(storeys, ", ")));
}

}  // namespace

Area area_of(const std::vector<Surface>& surfaces) {
    if (surfaces.empty()) return {};
    int x0 = INT_MAX, y0 = INT_MAX, x1 = INT_MIN, y1 = INT_MIN;
    for (const Surface& s : surfaces) {
        x0 = std::min(x0, s.x), x1 = std::max(x1, s.x);
        y0 = std::min(y0, s.y), y1 = std::max(y1, s.y);
    }
    return {x0, y0, x1 - x0 + 1, y1 - y0 + 1};
}

Floor reached_floor(const std::vector<Surface>& surfaces, const Area& area, float cell,
                    const Points& path, const Robot& robot, int storey) {
    const Map map(surfaces, area);
    Floor floor;
    // Sensors see no floor close to them; others see it later, unless the sensor stands.
    float radius = 3.0F;
    for (; radius < 30.0F; radius *= 2.0F) {
        floor.sensor_height = height_of_sensor(map, path, cell, radius);
        if (floor.sensor_height > 0.0F) break;
    }
    floor.storeys = storeys_of(path, floor.sensor_height);
    require(storey, floor.storeys);

    Growth growth(map, cell, robot);
    for (const Point& place : path) {
        const Surface below{cell_at(place.x(), cell), cell_at(place.y(), cell), 0.0F,
                            place.z() - floor.sensor_height};
        for (float r = 1.0F; !growth.begin(below, place, r) && r < radius; r *= 2.0F) {
        }
    }
    const std::vector<std::uint8_t> reached = growth.run();
    floor.height.assign(area.size(), kNoFloor);
    floor.driven.assign(area.size(), 0);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const Surface& s = surfaces[i];
        if (reached[i] == 0 || !is_on(s.top, floor.storeys, storey)) continue;
        float& height = floor.height[area.index(s.x, s.y)];
        floor.overlaps |= s.top - height > robot.height;  // false for kNoFloor
        height = s.top;
    }
    for (const Point& place : path) {
        const float below = place.z() - floor.sensor_height;
        if (!is_on(below, floor.storeys, storey)) continue;
        around(place, cell, kPathWidth, [&](int x, int y) {
            if (!area.holds(x, y)) return;
            float& height = floor.height[area.index(x, y)];
            floor.driven[area.index(x, y)] = 1;
            if (std::isnan(height) && !map.blocks(x, y, below, robot)) height = below;
        });
    }
    return floor;
}

}  // namespace dynamic_filter::app
