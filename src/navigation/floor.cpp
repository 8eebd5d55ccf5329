// SPDX-License-Identifier: MIT
#include "navigation/floor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <optional>

#include "dynamic_filter/error.hpp"
#include "navigation/surface_map.hpp"

namespace dynamic_filter::app {

namespace {

constexpr float kBridged = 2.5F;     // [m] between rings of a sensor, over which the floor goes on
constexpr float kPathWidth = 0.25F;  // [m] on each side, that the robot covered for sure
constexpr float kHighestSensor = 4.0F;    // [m] above the floor
constexpr float kStoreyHeight = 2.0F;     // [m] at least
constexpr std::size_t kLeastPlaces = 10;  // of the path, 0.1 m apart, on a storey
constexpr float kSteepest = 0.3F;         // of a ramp,
constexpr float kBridgedSlope = 0.08F;    // and of one over which the floor is not seen
constexpr float kNoise = 0.03F;           // [m] of the height of a floor

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
float height_of_sensor(const SurfaceMap& map, const Points& path, float cell, float radius) {
    constexpr float kHeightBin = 0.05F;
    struct Bin {
        std::size_t count = 0;
        double sum = 0.0;
    };
    std::vector<Bin> bins(static_cast<std::size_t>(kHighestSensor / kHeightBin) + 2);
    for (const Point& place : path) {
        around(place, cell, radius, [&](int x, int y) {
            map.each(x, y, [&](std::size_t i) {
                const float below = place.z() - map[i].top;
                if (below > 0.0F && below < kHighestSensor) {
                    Bin& bin = bins[static_cast<std::size_t>(below / kHeightBin)];
                    ++bin.count;
                    bin.sum += static_cast<double>(below);
                }
                return true;
            });
        });
    }
    Bin best;
    for (std::size_t i = 1; i + 1 < bins.size(); ++i) {
        const std::size_t count = bins[i - 1].count + bins[i].count + bins[i + 1].count;
        if (count <= best.count) continue;
        best = {count, bins[i - 1].sum + bins[i].sum + bins[i + 1].sum};
    }
    return best.count == 0 ? 0.0F : static_cast<float>(best.sum / static_cast<double>(best.count));
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
    enum class State : std::uint8_t { open, reached, refused };

    Growth(const SurfaceMap& map, float cell, const Robot& robot)
        : map_(map),
          cell_(cell),
          robot_(robot),
          ways_(ways(static_cast<int>(kBridged / cell))),
          state_(map.size(), State::open),
          stands_(map.size()),
          level_(map.size()) {}

    /// Begins around a place of the path; `below` is the floor that must be there. Returns whether
    /// there is any.
    bool begin(const Surface& below, const Point& place, float radius) {
        bool found = false;
        around(place, cell_, radius, [&](int x, int y) {
            map_.each(x, y, [&](std::size_t i) {
                if (std::abs(map_[i].top - below.top) > robot_.step) return true;
                if (state_[i] == State::open && is_open(below, map_[i])) seed(i, below.top, 0.0F);
                found |= state_[i] == State::reached;
                return true;
            });
        });
        return found;
    }
    std::vector<State> run() {
        while (!open_.empty()) {
            const std::size_t i = open_.front();
            open_.pop_front();
            grow(map_[i], level_[i]);
        }
        return std::move(state_);
    }

private:
    /// `level`: from which surface i is reached, at a distance [m].
    void seed(std::size_t i, float level, float distance) {
        if (state_[i] != State::open) return;
        const bool fits =
            map_.is_flat(i, cell_) && !map_.blocks(map_[i].x, map_[i].y, map_[i].top, robot_);
        state_[i] = fits ? State::reached : State::refused;
        if (!fits) return;
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
                    if (found && state_[i] == State::open && (touches || !stands(i))) {
                        seed(i, level, away);
                    }
                    return !found && map_[i].top < level;
                });
                if (found || map_.blocks(x, y, level, robot_)) break;
            }
        }
    }
    /// SurfaceMap::stands(), asked once of each surface.
    bool stands(std::size_t i) {
        if (!stands_[i]) stands_[i] = map_.stands(i, cell_, robot_);
        return *stands_[i];
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

    const SurfaceMap& map_;
    float cell_;
    const Robot& robot_;
    std::vector<Way> ways_;
    std::vector<State> state_;
    std::vector<std::optional<bool>> stands_;
    std::vector<float> level_;
    std::deque<std::size_t> open_;
};

/// Heights at which much of the path lies, a storey apart, from the lowest.
std::vector<float> storeys_of(const Points& path, float sensor_height) {
    constexpr float kLevelBin = 0.25F;
    const std::size_t least = std::min<std::size_t>(kLeastPlaces, path.size() / 10);
    std::map<int, std::size_t> counts;
    for (const Point& place : path) {
        ++counts[static_cast<int>(std::floor((place.z() - sensor_height) / kLevelBin))];
    }
    std::vector<float> storeys;
    while (!counts.empty()) {
        const auto most = std::max_element(counts.begin(), counts.end(),
                                           [](auto& a, auto& b) { return a.second < b.second; });
        if (most->second < least) break;
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
    const SurfaceMap map(surfaces, area);
    Floor floor;
    // Sensors see no floor close to them; others see it later, unless the sensor stands.
    float radius = 3.0F;
    for (; radius < 30.0F; radius *= 2.0F) {
        floor.sensor_height = height_of_sensor(map, path, cell, radius);
        if (floor.sensor_height > 0.0F) break;
    }
    floor.height.assign(area.size(), kNoFloor);
    floor.driven.assign(area.size(), 0);
    if (floor.sensor_height == 0.0F) return floor;
    floor.storeys = storeys_of(path, floor.sensor_height);
    require(storey, floor.storeys);

    Growth growth(map, cell, robot);
    for (const Point& place : path) {
        const Surface below{cell_at(place.x(), cell), cell_at(place.y(), cell), 0.0F,
                            place.z() - floor.sensor_height};
        for (float r = 1.0F; !growth.begin(below, place, r) && r < radius; r *= 2.0F) {
        }
    }
    const std::vector<Growth::State> reached = growth.run();
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const Surface& s = surfaces[i];
        if (reached[i] != Growth::State::reached || !is_on(s.top, floor.storeys, storey)) continue;
        float& height = floor.height[area.index(s.x, s.y)];
        floor.overlapping += s.top - height > robot.height ? 1 : 0;  // none for kNoFloor
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
