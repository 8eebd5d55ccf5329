// SPDX-License-Identifier: MIT
/// A street 260 m long with two lanes, parked cars, pavements and house facades. The sensor is on a
/// vehicle that drives at 5 m/s.
#include <algorithm>

#include "sim/people.hpp"
#include "sim/props.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {
namespace street {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double first = -40.0, last = 220.0;  // [m] along x
constexpr double lane = 1.75;               // [m] middle of a lane, from the middle of the street
constexpr double parking = 4.6;             // middle of the row of parked cars
constexpr double kerb = 5.7, front = 10.0;  // [m] edges of the pavement
constexpr double pavement = 0.15;           // [m] above the street
constexpr double crossings[] = {38.0, 78.0, 122.0, 160.0};
constexpr double bus_stop = 100.0;

bool is_kept_free(double x, double room) {
    return std::any_of(std::begin(crossings), std::end(crossings),
                       [&](double c) { return std::abs(x - c) < room; });
}

double ground(const Vector2d& p) {
    constexpr double step = 0.3;  // [m] over which people step up
    return pavement * std::clamp((std::abs(p.y()) - kerb) / step + 0.5, 0.0, 1.0);
}

void add_fronts(Scene& scene, std::uint64_t seed) {
    Random random{hash(seed, 0xf0)};
    for (const double side : {-1.0, 1.0}) {
        double x = first;
        while (x < last) {  // houses of three to six bays, each with its own depth and height
            const int bays = 3 + random.below(4);
            Facade house{.spot = {.axis = {side, 0.0}, .z = pavement},
                         .bays = {},
                         .bay_width = 3.6,
                         .upper_floors = 2 + random.below(3),
                         .seed = random.bits()};
            const Bay kinds[] = {Bay::wall, Bay::shop, Bay::recess, Bay::wall, Bay::shop};
            for (int i = 0; i < bays; ++i) house.bays.push_back(kinds[random.below(5)]);
            const double length = bays * house.bay_width;
            const double setback = random.uniform(0.0, 0.8);
            house.spot.at = {side > 0.0 ? x : x + length, side * (front + setback)};
            add_facade(scene, house);
            x += length + (random.chance(0.15) ? random.uniform(2.0, 5.0) : 0.0);
        }
    }
}

void add_furniture(Scene& scene, std::uint64_t seed) {
    Random random{hash(seed, 0xf1)};
    for (const double side : {-1.0, 1.0}) {
        for (const double x : row(first + 5.0, last, 11.0)) {
            const Spot tree{.at = {x, side * (kerb + 0.7)}, .axis = {1.0, 0.0}, .z = pavement};
            if (!is_kept_free(x, 2.5)) {
                const std::uint64_t shape = random.bits();
                add_tree(scene, tree, random.uniform(6.0, 9.0), shape);
            }
            const Spot lamp{
                .at = {x + 5.0, side * (kerb + 0.4)}, .axis = {0.0, -side}, .z = pavement};
            if (!is_kept_free(x + 5.0, 2.5)) add_lamp(scene, lamp, 6.5);
            const Spot wall{
                .at = {x + 3.0, side * (front - 0.5)}, .axis = {side, 0.0}, .z = pavement};
            switch (random.below(5)) {
                case 0:
                    add_bench(scene, wall);
                    break;
                case 1:
                    add_planter(scene, wall, random.bits());
                    break;
                case 2:
                    add_bin(scene, wall);
                    break;
                default:
                    break;
            }
        }
        for (const double x : row(first, last, 5.6)) {
            const bool at_stop = side > 0.0 && std::abs(x - bus_stop) < 24.0;
            if (is_kept_free(x, 4.5) || at_stop || random.chance(0.25)) continue;
            const auto brightness = static_cast<float>(random.uniform(0.4, 1.4));
            add_parked_car(
                scene, {.at = {x + random.uniform(-0.3, 0.3), side * parking}, .axis = {side, 0.0}},
                brightness);
        }
        for (const double x : crossings) {
            add_sign(
                scene,
                {.at = {x - side * 2.2, side * (kerb + 0.4)}, .axis = {0.0, 1.0}, .z = pavement});
        }
    }
    // shelter of the bus stop
    const Spot shelter{.at = {bus_stop, front - 1.6}, .axis = {1.0, 0.0}, .z = pavement};
    add_block(scene, shelter, {3.6, 0.08, 2.3}, 0.2F);
    add_bench(scene, {.at = {bus_stop, front - 2.0}, .axis = {1.0, 0.0}, .z = pavement});
    add_sign(scene, {.at = {bus_stop - 4.0, kerb + 0.4}, .axis = {0.0, 1.0}, .z = pavement});
}

Path straight(double y, double way) {
    return smooth_path({{way * -400.0, y}, {way * 0.0, y}, {way * 400.0, y}}, false);
}

/// Position along straight(y, way) of the place `x`.
double along(double x, double way) { return 400.0 + way * x; }

void add_traffic(Scene& scene, Random& random) {
    const auto ride = [&](VehicleKind kind, double y, double way, double x, double speed) {
        scene.vehicles.push_back(
            {.kind = kind,
             .ride = {.path = straight(y, way), .start = along(x, way), .speed = speed},
             .brightness = static_cast<float>(random.uniform(0.5, 1.4))});
    };
    // In the lane of the sensor, at the same speed.
    for (const double ahead : {-15.0, 16.0, 34.0, 62.0}) {
        ride(VehicleKind::car, -lane, 1.0, ahead, 5.0 + 0.01 * std::max(0.0, ahead));
    }
    for (const double x : {40.0, 75.0, 98.0}) ride(VehicleKind::car, lane, -1.0, x, 8.0);
    ride(VehicleKind::van, lane, -1.0, 120.0, 8.0);
    // The bus stops in its bay for ten seconds, so that the lane stays free.
    const Path bay = smooth_path({{500.0, lane},
                                  {200.0, lane},
                                  {128.0, lane},
                                  {118.0, lane},
                                  {108.0, lane + 2.4},
                                  {100.0, lane + 2.4},
                                  {92.0, lane + 2.4},
                                  {82.0, lane},
                                  {72.0, lane},
                                  {0.0, lane},
                                  {-300.0, lane}},
                                 false);
    double stop = 0.0;
    while (at(bay, stop).position.x() > bus_stop) stop += 0.1;
    scene.vehicles.push_back(
        {.kind = VehicleKind::bus,
         .ride = {
             .path = bay, .start = stop - 45.0, .speed = 7.0, .stop_at = stop, .stop_time = 10.0}});
    for (const double x : {195.0, 218.0, 252.0}) ride(VehicleKind::car, lane, -1.0, x, 8.0);
    ride(VehicleKind::cyclist, -3.15, 1.0, 32.0, 4.2);
    ride(VehicleKind::cyclist, -3.15, 1.0, 48.0, 4.4);
    ride(VehicleKind::cyclist, 3.15, -1.0, 66.0, 4.8);
    ride(VehicleKind::cyclist, 3.15, -1.0, 71.0, 4.7);
}

/// A route along a pavement and back, or over the street at a crossing and back.
std::vector<Waypoint> route(Random& random) {
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    std::vector<Waypoint> out;
    if (random.chance(0.3)) {
        const double x = crossings[random.below(4)] + random.uniform(-1.0, 1.0);
        for (const double s : {side, -side}) {
            out.push_back({.at = {x, s * (kerb + 0.5)}, .reach = 0.3});
            out.push_back({.at = {x, s * 7.8}});
            out.push_back({.at = {x + random.uniform(10.0, 25.0), s * 7.8}});
            out.push_back({.at = {x, s * 8.4}});
            out.push_back({.at = {x, s * (kerb + 0.5)}, .reach = 0.3, .gated = true});
        }
        return out;
    }
    const double a = random.uniform(-10.0, 120.0), b = a + random.uniform(50.0, 80.0);
    const double y = random.uniform(7.4, 9.0), z = random.uniform(7.4, 9.0);
    for (const double x : row(a, b, 8.0)) out.push_back({.at = {x, side * y}});
    for (const double x : row(a, b, 8.0)) out.push_back({.at = {a + b - x, side * z}});
    return out;
}

}  // namespace
}  // namespace street

Scene street_scene(int pedestrians, std::uint64_t seed) {
    using namespace street;
    Scene scene;
    scene.low = {first - 5.0, -14.0};
    scene.high = {last + 5.0, 14.0};
    scene.floor = 0.05;
    scene.ground = ground;
    add_ground(scene, AlignedBox2d(Vector2d(-300, -kerb), Vector2d(500, kerb)), 0.0, 0.2F);
    for (const double side : {-1.0, 1.0}) {
        const double low = std::min(side * kerb, side * 40.0);
        add_ground(scene, AlignedBox2d(Vector2d(-300, low), Vector2d(500, low + 40.0 - kerb)),
                   pavement, 0.3F);
        add_quad(scene.still, {-300, side * kerb, 0}, {800, 0, 0}, {0, 0, pavement},
                 {0.4F, Kind::ground});
    }
    add_fronts(scene, seed);
    add_furniture(scene, seed);
    Random random{hash(seed, 0x57)};
    add_traffic(scene, random);
    for (int i = 0; i < pedestrians; ++i) {
        Walker walker = draw_walker(random);
        walker.route = route(random);
        scene.walkers.push_back(walker);
    }
    const DistanceField field = distance_field(scene.obstacles, scene.low, scene.high);
    scatter(scene.walkers, field, random);
    scene.robot = {.path = straight(-lane, 1.0), .start = along(0.0, 1.0), .speed = 5.0};
    scene.robot_radius = 1.2;
    scene.sensor_height = 1.8;
    scene.duration = 30.0;
    return scene;
}

}  // namespace dynamic_filter::sim
