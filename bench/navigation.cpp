// SPDX-License-Identifier: MIT
/// Compares maps for navigation with the exact ground and obstacles of a simulated scene.
///   navigation SCENE SENSOR SEED FRAMES RATE [PICTURE.png]
/// Simulates a scene, filters it, and makes three maps with cells of 5 cm:
/// - ours: what `convert --to nav2` makes of the final labels;
/// - static, flattened: cells with points of the static map at the height of the robot, counted
///   from the floor below the first place of the sensor, are occupied, all others free;
/// - raw, flattened: the same of all points.
/// In truth, a cell is free if the robot can get there from its path without a step, and nothing
/// static is in its way. Printed are, within 10 m of the path and of the cells that ours holds, how
/// many of the free cells are called occupied or unknown, and how many of those with something in
/// the way are called free. A free or occupied cell beside one for which its verdict is right is
/// right, too. The last column is the share of the robot's places that a planner reaches from the
/// first one, for a robot with a radius of 0.25 m. The picture shows truth and the three maps, one
/// below the other: free cells are white, occupied ones black, unknown ones grey, free ones called
/// occupied orange and occupied ones called free red.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scene_arguments.hpp"
#include "draw/png.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/simulation.hpp"
#include "navigation/surface_map.hpp"
#include "navigation/survey.hpp"
#include "sim/caster.hpp"
#include "sim/scene.hpp"

namespace {

using namespace dynamic_filter;
using namespace dynamic_filter::app;

constexpr float kCell = 0.05F, kNear = 10.0F;
const Robot kRobot{};

/// What stands still in a scene, exactly.
class StillScene {
public:
    explicit StillScene(const sim::SimulationOptions& options)
        : scene_(made(options)), caster_(scene_.still, {}, {}) {}

    /// In the world.
    [[nodiscard]] float ground(float x, float y) const {
        return static_cast<float>(scene_.floor + (scene_.ground ? scene_.ground({x, y}) : 0.0));
    }
    /// Whether a surface passes through the cell between step and height of the robot.
    [[nodiscard]] bool blocks(float x, float y) const {
        const float floor = ground(x, y) - static_cast<float>(scene_.floor), half = 0.5F * kCell;
        for (float z = floor + kRobot.step; z < floor + kRobot.height; z += 0.05F) {
            if (meets({x - half, y, z}, Point::UnitX()) ||
                meets({x, y - half, z}, Point::UnitY())) {
                return true;
            }
        }
        const float room = kRobot.height - kRobot.step;
        return caster_.cast({x, y, floor + kRobot.height}, -Point::UnitZ(), room).found;
    }

private:
    static sim::Scene made(const sim::SimulationOptions& options) {
        for (const sim::SceneEntry& entry : sim::scene_table()) {
            if (entry.name == options.scene) return entry.make(entry.pedestrians, options.seed);
        }
        throw ConfigError(options.scene + ": there is no such scene");
    }
    [[nodiscard]] bool meets(const Point& from, const Point& direction) const {
        return caster_.cast(from, direction, kCell).found;
    }
    sim::Scene scene_;
    sim::Caster caster_;
};

struct Maps {
    NavigationMap ours;
    std::vector<Passage> static_flat, raw_flat;
    Eigen::Vector3d origin;
    Points path;  // in the frame of the map
};

Maps maps_of(const sim::SimulationOptions& options) {
    sim::Simulation simulation(options);
    DynamicFilter filter(preset("default"));
    std::vector<Scan> scans;
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        sim::SimulatedScan s = simulation.scan(i);
        scans.push_back({std::move(s.points), s.T_world_sensor, s.stamp, i, true, {}});
        filter.push(scans.back());
    }
    filter.finish();
    Survey survey(kCell);
    std::vector<Labels> labels;
    for (const Scan& scan : scans) {
        labels.push_back(filter.verdict(scan).labels);
        survey.add(scan.points, labels.back(), scan.T_world_sensor, scan.stamp);
    }
    Maps maps{survey.map(kRobot, 0), {}, {}, survey.origin(), {}};
    maps.static_flat.assign(maps.ours.area.size(), Passage::free);
    maps.raw_flat = maps.static_flat;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const Pose T = Eigen::Translation3d(-maps.origin) * scans[i].T_world_sensor;
        maps.path.push_back(T.translation().cast<float>());
        const float floor = maps.path.front().z() - maps.ours.floor.sensor_height;
        for (std::size_t k = 0; k < scans[i].points.size(); ++k) {
            const Point p = T.cast<float>() * scans[i].points[k];
            const int x = cell_at(p.x(), kCell), y = cell_at(p.y(), kCell);
            const bool is_in_way =
                p.z() > floor + kRobot.step && p.z() < floor + kRobot.height && is_measured(p);
            if (!is_in_way || !maps.ours.area.holds(x, y)) continue;
            const std::size_t cell = maps.ours.area.index(x, y);
            maps.raw_flat[cell] = Passage::occupied;
            if (labels[i][k] == Label::static_) maps.static_flat[cell] = Passage::occupied;
        }
    }
    return maps;
}

/// Cells near the path, what is in the way, and what of the rest can be reached from the path.
std::vector<Passage> truth_of(const StillScene& scene, const Maps& maps) {
    const Area& area = maps.ours.area;
    std::vector<Passage> truth(area.size(), Passage::unknown);
    std::vector<float> ground(area.size(), kNoFloor);
    std::vector<std::pair<int, int>> open;
    const auto middle = [&](int c, double origin) {
        return static_cast<float>((c + 0.5) * kCell + origin);
    };
    const auto reach = static_cast<int>(kNear / kCell);
    for (const Point& place : maps.path) {
        const int px = cell_at(place.x(), kCell), py = cell_at(place.y(), kCell);
        open.emplace_back(px, py);
        for (int y = py - reach; y <= py + reach; ++y) {
            for (int x = px - reach; x <= px + reach; ++x) {
                if (!area.holds(x, y) || !std::isnan(ground[area.index(x, y)])) continue;
                const float wx = middle(x, maps.origin.x()), wy = middle(y, maps.origin.y());
                ground[area.index(x, y)] = scene.ground(wx, wy);
                if (scene.blocks(wx, wy)) truth[area.index(x, y)] = Passage::occupied;
            }
        }
    }
    while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        if (!area.holds(x, y) || truth[area.index(x, y)] == Passage::occupied) continue;
        truth[area.index(x, y)] = Passage::free;
        for (const auto& [dx, dy] :
             std::array<std::array<int, 2>, 4>{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}}) {
            if (!area.holds(x + dx, y + dy)) continue;
            const std::size_t next = area.index(x + dx, y + dy);
            const float rise = ground[next] - ground[area.index(x, y)];
            // Also false where the ground is not near.
            if (truth[next] == Passage::unknown && std::abs(rise) <= kRobot.step)
                open.emplace_back(x + dx, y + dy);
        }
    }
    return truth;
}

/// Whether a cell or one beside it has that verdict.
bool has_near(const std::vector<Passage>& cells, const Area& area, int x, int y, Passage verdict) {
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            if (area.holds(x + dx, y + dy) && cells[area.index(x + dx, y + dy)] == verdict)
                return true;
        }
    }
    return false;
}

enum class Mistake { none, free_for_occupied, occupied_for_free, unknown_for_free };

Mistake mistake_at(const std::vector<Passage>& cells, const std::vector<Passage>& truth,
                   const Area& area, int x, int y) {
    const Passage is = truth[area.index(x, y)], called = cells[area.index(x, y)];
    if (is == Passage::occupied && called == Passage::free) {
        const bool is_at_border = has_near(truth, area, x, y, Passage::free) &&
                                  has_near(cells, area, x, y, Passage::occupied);
        return is_at_border ? Mistake::none : Mistake::free_for_occupied;
    }
    if (is != Passage::free) return Mistake::none;
    if (called == Passage::occupied && !has_near(truth, area, x, y, Passage::occupied))
        return Mistake::occupied_for_free;
    return called == Passage::unknown ? Mistake::unknown_for_free : Mistake::none;
}

/// Cells on which the middle of a robot with a radius of 0.25 m fits.
std::vector<bool> fits(const std::vector<Passage>& cells, const Area& area) {
    const auto reach = static_cast<int>(0.25F / kCell);
    std::vector<bool> fit(area.size(), true);
    for (int y = area.y; y < area.y + area.height; ++y) {
        for (int x = area.x; x < area.x + area.width; ++x) {
            const Passage cell = cells[area.index(x, y)];
            if (cell != Passage::free) fit[area.index(x, y)] = false;
            if (cell != Passage::occupied) continue;
            for (int dy = -reach; dy <= reach; ++dy) {
                for (int dx = -reach; dx <= reach; ++dx) {
                    const bool is_close = dx * dx + dy * dy <= reach * reach;
                    if (is_close && area.holds(x + dx, y + dy)) {
                        fit[area.index(x + dx, y + dy)] = false;
                    }
                }
            }
        }
    }
    return fit;
}

/// The share of the places of the robot that a planner reaches from the first one [%].
double reached_share(const std::vector<Passage>& cells, const Area& area, const Points& path) {
    const std::vector<bool> open = fits(cells, area);
    const auto cell_of_place = [](const Point& p) {
        return std::pair(cell_at(p.x(), kCell), cell_at(p.y(), kCell));
    };
    std::vector<bool> reached(area.size(), false);
    std::vector<std::pair<int, int>> next{cell_of_place(path.front())};
    while (!next.empty()) {
        const auto [x, y] = next.back();
        next.pop_back();
        if (!area.holds(x, y) || reached[area.index(x, y)] || !open[area.index(x, y)]) continue;
        reached[area.index(x, y)] = true;
        next.insert(next.end(), {{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}});
    }
    std::size_t count = 0;
    for (const Point& place : path) {
        const auto [x, y] = cell_of_place(place);
        count += area.holds(x, y) && reached[area.index(x, y)] ? 1 : 0;
    }
    return 100.0 * static_cast<double>(count) / static_cast<double>(path.size());
}

void print(std::string_view name, const std::vector<Passage>& cells,
           const std::vector<Passage>& truth, const Area& area, const Points& path) {
    std::array<std::size_t, 4> mistakes{};
    std::size_t free = 0, occupied = 0;
    for (int y = area.y; y < area.y + area.height; ++y) {
        for (int x = area.x; x < area.x + area.width; ++x) {
            free += truth[area.index(x, y)] == Passage::free;
            occupied += truth[area.index(x, y)] == Passage::occupied;
            ++mistakes[static_cast<std::size_t>(mistake_at(cells, truth, area, x, y))];
        }
    }
    const auto share = [](std::size_t n, std::size_t all) {
        return all == 0 ? 0.0 : 100.0 * static_cast<double>(n) / static_cast<double>(all);
    };
    fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {:.0f} |\n", name, share(mistakes[1], occupied),
               share(mistakes[2], free), share(mistakes[3], free),
               reached_share(cells, area, path));
}

void draw(const std::string& file, const Maps& maps, const std::vector<Passage>& truth) {
    const Area& area = maps.ours.area;
    const std::array<const std::vector<Passage>*, 4> all{&truth, &maps.ours.cells,
                                                         &maps.static_flat, &maps.raw_flat};
    io::Image image{area.width, 4 * area.height, {}};
    image.pixels.resize(4 * area.size());
    for (std::size_t m = 0; m < all.size(); ++m) {
        for (int y = 0; y < area.height; ++y) {
            for (int x = 0; x < area.width; ++x) {
                const int cx = area.x + x, cy = area.y + area.height - 1 - y;
                const Passage cell = (*all[m])[area.index(cx, cy)];
                io::Color color{205, 205, 205};
                if (cell == Passage::free) color = {255, 255, 255};
                if (cell == Passage::occupied) color = {0, 0, 0};
                const Mistake mistake = mistake_at(*all[m], truth, area, cx, cy);
                if (mistake == Mistake::free_for_occupied) color = {230, 0, 0};
                if (mistake == Mistake::occupied_for_free) color = {255, 150, 0};
                const auto row =
                    m * static_cast<std::size_t>(area.height) + static_cast<std::size_t>(y);
                image.pixels[row * static_cast<std::size_t>(area.width) +
                             static_cast<std::size_t>(x)] = color;
            }
        }
    }
    io::write_png(file, image);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::vector<std::string_view> words(argv + 1, argv + argc);
        if (words.size() < kSceneArguments || words.size() > kSceneArguments + 1) {
            fmt::print(stderr, "usage: navigation SCENE SENSOR SEED FRAMES RATE [PICTURE.png]\n");
            return 2;
        }
        const sim::SimulationOptions options = scene_of(words);
        const Maps maps = maps_of(options);
        const std::vector<Passage> truth = truth_of(StillScene(options), maps);
        fmt::print(
            "| map | free for occupied [%] | occupied for free [%] | unknown for free [%] "
            "| reached [%] |\n|---|---|---|---|---|\n");
        print("ours", maps.ours.cells, truth, maps.ours.area, maps.path);
        print("static, flattened", maps.static_flat, truth, maps.ours.area, maps.path);
        print("raw, flattened", maps.raw_flat, truth, maps.ours.area, maps.path);
        if (words.size() > kSceneArguments) draw(std::string(words.back()), maps, truth);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "navigation: {}\n", error.what());
        return 1;
    }
}
