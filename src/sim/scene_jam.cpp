// SPDX-License-Identifier: MIT
/// A street 470 m long. In the scene `jam`, with three traffic lights: cars queue, stand and start;
/// a bus stands at its stop; a van delivers; cars park and leave; the sensor is on a car of the
/// queue. In the scene `queue`, the sensor drives by.
#include <algorithm>

#include "sim/jam.hpp"
#include "sim/props.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {
namespace jam {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double street_from = -70.0, street_until = 400.0;  // [m] along x

double ground(const Vector2d& p) {
    constexpr double step = 0.3;  // [m] over which people step up
    return pavement * std::clamp((std::abs(p.y()) - kerb) / step + 0.5, 0.0, 1.0);
}

void add_grounds(Scene& scene) {
    add_ground(scene, AlignedBox2d(Vector2d(-300, -kerb), Vector2d(600, kerb)), 0.0, 0.2F);
    for (const double side : {-1.0, 1.0}) {
        const double low = std::min(side * kerb, side * 40.0);
        add_ground(scene, AlignedBox2d(Vector2d(-300, low), Vector2d(600, low + 40.0 - kerb)),
                   pavement, 0.3F);
        add_quad(scene.still, {-300, side * kerb, 0}, {900, 0, 0}, {0, 0, pavement},
                 {0.4F, Kind::ground});
    }
}

/// Houses of three to six bays, each with its own depth and height.
void add_fronts(Scene& scene, double side, Random& random) {
    double x = street_from;
    while (x < street_until) {
        const int bays = 3 + random.below(4);
        Facade house{.spot = {.axis = {side, 0.0}, .z = pavement},
                     .bays = {},
                     .bay_width = 3.6,
                     .upper_floors = 1 + random.below(4),
                     .seed = random.bits()};
        const Bay kinds[] = {Bay::wall, Bay::shop, Bay::recess, Bay::wall, Bay::shop};
        for (int i = 0; i < bays; ++i) house.bays.push_back(kinds[random.below(5)]);
        const double length = bays * house.bay_width;
        house.spot.at = {side > 0.0 ? x : x + length, side * (front + random.uniform(0.0, 0.8))};
        add_facade(scene, house);
        x += length + (random.chance(0.15) ? random.uniform(2.0, 5.0) : 0.0);
    }
}

bool is_free(const Plan& plan, double side, double x, double room) {
    return std::any_of(plan.free.begin(), plan.free.end(), [&](const Free& free) {
        return free.side == side && x > free.from - room && x < free.until + room;
    });
}

bool is_crossing(const Plan& plan, double x, double room) {
    return std::any_of(plan.signals.begin(), plan.signals.end(),
                       [&](const Signal& signal) { return std::abs(x - signal.at) < room; });
}

/// Trees and lamps at the kerb, and objects at the walls.
void add_furniture(Scene& scene, const Plan& plan, double side, Random& random) {
    const auto kept = [&](double x) {
        return is_crossing(plan, x, 3.5) || (side > 0.0 && std::abs(x - plan.bus_stop) < 6.5);
    };
    for (const double x : row(street_from + 5.0, street_until, 12.0)) {
        const Spot tree{.at = {x, side * (kerb + 0.7)}, .axis = {1.0, 0.0}, .z = pavement};
        const double height = random.uniform(6.0, 9.0);
        if (!kept(x)) add_tree(scene, tree, height, random.bits());
        const Spot lamp{.at = {x + 6.0, side * (kerb + 0.4)}, .axis = {0.0, -side}, .z = pavement};
        if (!kept(x + 6.0)) add_lamp(scene, lamp, 6.5);
        const Spot wall{.at = {x + 3.0, side * (front - 0.5)}, .axis = {side, 0.0}, .z = pavement};
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
}

/// Cars that are parked all the time: one every 5.8 m, with some gaps.
void add_parked(Scene& scene, const Plan& plan, double side, Random& random) {
    for (const double x : row(street_from, street_until, 5.8)) {
        if (is_free(plan, side, x, 2.6) || random.chance(0.2)) continue;
        const Spot spot{.at = {x + random.uniform(-0.3, 0.3), side * parking}, .axis = {side, 0.0}};
        add_parked_car(scene, spot, static_cast<float>(random.uniform(0.4, 1.4)));
    }
}

/// The masts of the lights, and the shelter at the bus stop.
void add_masts(Scene& scene, const Plan& plan) {
    for (const Signal& signal : plan.signals) {
        for (const double side : {-1.0, 1.0}) {
            const Spot mast{.at = {signal.at + side * 2.6, side * (kerb + 0.35)},
                            .axis = {0.0, 1.0},
                            .z = pavement};
            add_sign(scene, mast);
        }
    }
    const Spot shelter{.at = {plan.bus_stop, front - 1.4}, .axis = {1.0, 0.0}, .z = pavement};
    add_block(scene, shelter, {3.6, 0.08, 2.3}, 0.2F);
    add_sign(scene, {.at = {plan.bus_stop - 5.5, kerb + 0.4}, .axis = {0.0, 1.0}, .z = pavement});
}

void add_traffic(Scene& scene, const Plan& plan, Random& random) {
    std::vector<Ride> rides = drive(plan.drivers, plan.signals, begin, plan.duration + 30.0);
    scene.robot = rides.front();
    for (std::size_t i = 1; i < rides.size(); ++i) {
        scene.vehicles.push_back({.kind = plan.drivers[i].kind,
                                  .ride = std::move(rides[i]),
                                  .brightness = static_cast<float>(random.uniform(0.5, 1.4))});
    }
}

Scene scene_of(const Plan& plan, int pedestrians, std::uint64_t seed) {
    Scene scene;
    scene.low = {street_from - 5.0, -15.0};
    scene.high = {street_until + 5.0, 15.0};
    scene.floor = 0.05;
    scene.ground = ground;
    scene.robot_radius = 1.2;
    scene.sensor_height = 1.82;
    scene.duration = plan.duration;
    Random random{hash(seed, 0x7a3)};
    add_grounds(scene);
    for (const double side : {-1.0, 1.0}) {
        add_fronts(scene, side, random);
        add_furniture(scene, plan, side, random);
        add_parked(scene, plan, side, random);
    }
    add_masts(scene, plan);
    add_traffic(scene, plan, random);
    const DistanceField field = distance_field(scene.obstacles, scene.low, scene.high);
    scene.walkers = people(pedestrians, plan, field, seed);
    return scene;
}

}  // namespace
}  // namespace jam

Scene jam_scene(int pedestrians, std::uint64_t seed) {
    return jam::scene_of(jam::jam_plan(seed), pedestrians, seed);
}

Scene queue_scene(int pedestrians, std::uint64_t seed) {
    return jam::scene_of(jam::queue_plan(seed), pedestrians, seed);
}

}  // namespace dynamic_filter::sim
