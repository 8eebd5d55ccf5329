// SPDX-License-Identifier: MIT
/// A pedestrian mall, 70 m x 10 m (Sec. IV-A). People walk along it in lanes, and cross it between
/// doors. The robot drives an elongated loop twice.
#include <algorithm>

#include "sim/people.hpp"
#include "sim/props.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {
namespace crowd {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double half_length = 35.1, half_width = 5.1;
constexpr double lobby_depth = 2.6;  // behind the ends, where people turn
constexpr double crossings[] = {-22.0, 2.0, 22.0};
constexpr double first_bay = -36.0, bay_width = 4.0;
constexpr std::size_t bays = 18;

std::size_t bay_at(double x) { return static_cast<std::size_t>((x - first_bay) / bay_width); }

bool is_crossing(double x, double room) {
    return std::any_of(std::begin(crossings), std::end(crossings),
                       [&](double c) { return std::abs(x - c) < room; });
}

/// One of the two facades; `side` is +1 for the one at y = +5.
Facade front(double side, std::uint64_t seed) {
    Facade facade{.spot = {.at = {side * first_bay, side * half_width}, .axis = {side, 0.0}},
                  .bays = std::vector<Bay>(bays, Bay::wall),
                  .bay_width = bay_width,
                  .ground_floor = 2.9,
                  .upper_floors = 0,
                  .room_depth = 2.4,
                  .seed = hash(seed, side > 0.0 ? 1 : 2)};
    const Bay others[] = {Bay::wall, Bay::wall, Bay::recess, Bay::wall, Bay::wall,
                          Bay::wall, Bay::shop, Bay::wall,   Bay::wall};
    for (std::size_t i = 0; i < bays; ++i) facade.bays[i] = others[(i + (side > 0.0 ? 0 : 3)) % 9];
    for (const double x : crossings) facade.bays[bay_at(side * x)] = Bay::door;
    return facade;
}

/// The walls at the ends, with two gates each and a lobby behind.
void add_ends(Scene& scene) {
    for (const double side : {-1.0, 1.0}) {
        const double x = side * half_length;
        for (const double y : {-5.1, 0.0, 5.1}) {
            add_block(scene, {.at = {x, y}}, {0.3, y == 0.0 ? 1.4 : 2.6, 2.9}, 0.5F);
        }
        add_block(scene, {.at = {side * (half_length + lobby_depth), 0.0}}, {0.3, 10.4, 2.9}, 0.5F);
        for (const double y : {-5.2, 5.2}) {
            add_block(scene, {.at = {side * (half_length + lobby_depth / 2), y}},
                      {lobby_depth, 0.3, 2.9}, 0.5F);
        }
    }
}

/// The strip in the middle, between the two legs of the robot's loop.
void add_middle(Scene& scene, std::uint64_t seed) {
    for (const double x : row(-28.0, 28.0, 2.0)) {  // hedges between the two lanes
        if (is_crossing(x + 1.0, 2.0)) continue;
        for (const double y : {-0.55, 0.55})
            add_block(scene, {.at = {x + 1.0, y}}, {2.0, 0.2, 0.45}, 0.35F);
    }
    int kind = 0;
    for (const double x : row(-28.0, 28.1, 2.8)) {
        if (is_crossing(x, 1.9)) continue;
        const Spot spot{.at = {x, 0.0}};
        switch (kind++ % 6) {
            case 0:
                add_column(scene, spot, 0.22, 4.0);
                break;
            case 1:
                add_planter(scene, spot, hash(seed, 10 + static_cast<std::uint64_t>(kind)));
                break;
            case 2:
                add_bench(scene, spot);
                break;
            case 3:
                add_tree(scene, spot, 4.5, hash(seed, 50 + static_cast<std::uint64_t>(kind)));
                break;
            case 4:
                add_bin(scene, spot);
                break;
            default:
                add_bench(scene, {.at = spot.at, .axis = {-1.0, 0.0}});
                break;
        }
    }
}

/// Objects along the facades, outside the lanes.
void add_sides(Scene& scene, std::uint64_t seed) {
    Random random{hash(seed, 0x51de)};
    for (const double side : {-1.0, 1.0}) {
        for (const double x : row(-33.0, 33.0, 2.0)) {
            if (!is_crossing(x + 1.0, 2.0)) add_railing(scene, {.at = {x + 1.0, side * 3.7}}, 2.0);
        }
        for (const double x : row(-33.0, 33.1, 2.2)) {
            if (is_crossing(x, 2.2) || random.chance(0.45)) continue;
            const Spot spot{.at = {x, side * 4.55}, .axis = {side, 0.0}};
            switch (random.below(4)) {
                case 0:
                    add_bench(scene, spot);
                    break;
                case 1:
                    add_planter(scene, spot, random.bits());
                    break;
                case 2:
                    add_sign(scene, spot);
                    break;
                case 3:
                    add_bin(scene, spot);
                    break;
            }
        }
    }
}

/// A route of some laps: along one lane, round in the lobby, and back in another lane.
std::vector<Waypoint> lane_route(int turn, Random& random) {
    std::vector<Waypoint> route;
    for (const double way : {1.0, -1.0, 1.0, -1.0, 1.0, -1.0}) {
        ++turn;  // other lanes in the next lap
        const double half = ((way > 0.0 ? turn : turn / 2) % 2 == 0) ? 1.0 : -1.0;
        const double y =
            half * (way * half > 0.0 ? random.uniform(1.0, 2.1) : random.uniform(2.15, 3.25));
        for (const double x : row(-30.0, 30.1, 5.0)) {
            route.push_back({.at = {way * x, y + random.uniform(-0.15, 0.15)}});
        }
        const double gate = half * random.uniform(1.3, 3.1);
        route.push_back({.at = {way * (half_length - 0.5), gate}, .reach = 0.6});
        route.push_back({.at = {way * (half_length + 0.8), gate}, .reach = 0.8});
        route.push_back({.at = {way * random.uniform(36.2, 36.9), random.uniform(-3.5, 3.5)},
                         .pause = random.uniform(0.0, 2.0)});
        const double back = (random.chance(0.5) ? 1.0 : -1.0) * random.uniform(1.2, 3.2);
        route.push_back({.at = {way * (half_length + 0.8), back}, .reach = 0.6});
        route.push_back({.at = {way * (half_length - 1.0), back}, .reach = 0.8});
    }
    return route;
}

/// A route from one room to the one opposite and back.
std::vector<Waypoint> crossing_route(const Facade& left, const Facade& right, int turn,
                                     Random& random) {
    const double x = crossings[turn % 3];
    std::vector<Waypoint> route;
    for (const Facade* facade : {&left, &right}) {
        const double side = facade == &left ? 1.0 : -1.0;
        const std::size_t bay = bay_at(side * x);
        const Waypoint door{.at = doorway(*facade, bay), .reach = 0.4};
        const double aside = random.uniform(-0.5, 0.5);
        route.push_back({.at = {x + aside, side * 1.5}});
        route.push_back({.at = {x + 0.5 * aside, side * 3.8}, .reach = 0.6});
        route.push_back(door);
        route.push_back({.at = behind_door(*facade, bay) + Vector2d(random.uniform(-1.0, 1.0), 0.0),
                         .reach = 0.5,
                         .pause = random.uniform(0.0, 6.0)});
        route.push_back(door);
        route.push_back({.at = {x - 0.5 * aside, side * 3.8}, .reach = 0.6});
    }
    return route;
}

/// Adds a conversation to a route: at the edge of a lane, outside the way of the robot.
void add_chat(std::vector<Waypoint>& route, Random& random) {
    const auto k = static_cast<std::size_t>(random.below(9)) + 2;
    const Vector2d lane = route[k].at;
    const Vector2d middle(lane.x(), (lane.y() > 0.0 ? 1.0 : -1.0) * 3.5);
    route[k] = {.at = middle + Vector2d(-0.45, 0.0),
                .reach = 0.4,
                .pause = random.uniform(5.0, 25.0),
                .face = middle};
}

std::vector<Walker> people(int count, const Facade& left, const Facade& right, Random& random) {
    std::vector<Walker> walkers;
    int companies = 0, turn = 0, crossing = 0;  // so that routes are distributed evenly
    while (static_cast<int>(walkers.size()) < count) {
        Walker walker = draw_walker(random);
        const int room = count - static_cast<int>(walkers.size());
        if (random.chance(0.1)) {
            walker.route = crossing_route(left, right, crossing++, random);
            walkers.push_back(walker);
        } else if (room >= 3 && random.chance(0.06)) {
            walker.route = lane_route(turn++, random);
            walker.company = companies++;
            walker.speed = std::min(walker.speed, 1.2);
            add_chat(walker.route, random);
            walkers.push_back(walker);
            walkers.push_back(companion(walker, 0.55, random));
            if (random.chance(0.4)) walkers.push_back(companion(walker, -0.55, random));
        } else {
            walker.route = lane_route(turn++, random);
            walkers.push_back(walker);
        }
    }
    return walkers;
}

}  // namespace
}  // namespace crowd

Scene crowd_scene(int pedestrians, std::uint64_t seed) {
    using namespace crowd;
    Scene scene;
    scene.low = {-half_length - lobby_depth - 1.0, -10.0};
    scene.high = -scene.low;
    add_ground(scene, AlignedBox2d(Vector2d(-60, -30), Vector2d(60, 30)), 0.0, 0.3F);
    const Facade left = front(1.0, seed), right = front(-1.0, seed);
    add_facade(scene, left);
    add_facade(scene, right);
    add_ends(scene);
    add_middle(scene, seed);
    add_sides(scene, seed);

    Random random{hash(seed, 0xc20d)};
    scene.walkers = people(pedestrians, left, right, random);
    const DistanceField field = distance_field(scene.obstacles, scene.low, scene.high);
    scatter(scene.walkers, field, random);

    scene.robot = {.path = stadium(29.5, 1.8, -24.0), .start = 0.0, .speed = 1.0};
    scene.robot_radius = 0.4;
    scene.sensor_height = 0.8;
    scene.floor = 0.05;
    scene.duration = 2.0 * scene.robot.path.lengths.back() / scene.robot.speed;
    return scene;
}

}  // namespace dynamic_filter::sim
