// SPDX-License-Identifier: MIT
/// A yard, 56 m x 30 m, where things move at 0.05 to 0.3 m/s: people in four lines, cars and vans
/// that creep, a gate that slides and a load that is carried. Between them are things of the same
/// shape that never move: parked cars and vans, figures, blocks. The robot drives in rounds.
#include <cmath>

#include "sim/people.hpp"
#include "sim/props.hpp"
#include "sim/prototypes.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {
namespace slow {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double half_length = 28.0, half_width = 15.0;  // [m]
constexpr double speeds[] = {0.05, 0.1, 0.2, 0.3};       // [m/s]
constexpr double first_line = 4.8, between_lines = 1.7;  // [m] y of the lines of people
constexpr double lane = -5.2, parking = -8.2;            // [m] y

double about(double value, Random& random) { return value * random.uniform(0.85, 1.15); }

void add_shell(Scene& scene, Random& random) {
    add_ground(scene, AlignedBox2d(Vector2d(-80, -80), Vector2d(80, 80)), 0.0, 0.3F);
    for (const double side : {-1.0, 1.0}) {
        Facade facade{.spot = {.at = {-side * half_length, side * half_width}, .axis = {side, 0.0}},
                      .bays = {},
                      .bay_width = 4.0,
                      .upper_floors = 1,
                      .seed = random.bits()};
        const Bay kinds[] = {Bay::wall, Bay::shop, Bay::recess, Bay::wall};
        for (int i = 0; i < 14; ++i) facade.bays.push_back(kinds[random.below(4)]);
        add_facade(scene, facade);
    }
    for (const double x : {-half_length - 2.0, half_length + 2.0})
        add_block(scene, {.at = {x, 0.0}}, {0.3, 2.0 * half_width, 3.5}, 0.4F);
    for (const double x : {-21.5, 21.5}) {
        const std::uint64_t shape = random.bits();
        add_tree(scene, {.at = {x, 12.6}}, random.uniform(5.5, 8.0), shape);
        add_lamp(scene, {.at = {x, -11.0}, .axis = {0.0, 1.0}}, 5.0);
    }
}

/// A person who never moves, as a part of the static scene.
void add_figure(Scene& scene, const Vector2d& at, Random& random) {
    const Walker shape = draw_walker(random);
    const double tall = shape.height / 1.75;
    const Eigen::Affine3d T = shift(at.x(), at.y(), 0.0) *
                              Eigen::AngleAxisd(random.uniform(0.0, 6.28), Vector3d::UnitZ()) *
                              Eigen::Scaling(tall);
    const std::vector<Mesh> shapes = prototypes();
    const auto mesh = [&](Prototype p) { return shapes[static_cast<std::size_t>(p)]; };
    append(scene.still, mesh(Prototype::torso), T);
    for (const double side : {-1.0, 1.0}) {
        append(scene.still, mesh(Prototype::leg), T * shift(0.0, 0.09 * side, 1.75 * leg_length));
        append(scene.still, mesh(Prototype::arm), T * shift(0.0, 0.23 * side, 1.4));
    }
    scene.obstacles.push_back({.centre = at, .radius = 0.25});
}

/// What never moves, beside what does.
void add_still(Scene& scene, Random& random) {
    for (const double x : row(-21.0, 22.0, 6.2)) {
        if (random.chance(0.2)) continue;
        const Spot spot{.at = {x + random.uniform(-0.4, 0.4), parking}};
        add_parked_car(scene, spot, static_cast<float>(random.uniform(0.5, 1.4)));
    }
    for (int line = 0; line < 4; ++line) {
        const double y = first_line + between_lines * (line + 0.5);
        for (const double x : row(-16.0, 20.0, 6.0))
            add_figure(scene, {x + random.uniform(-2.0, 2.0), y}, random);
    }
    for (const double x : {-19.0, 20.0}) {
        add_block(scene, {.at = {x, 3.6}}, {1.8, 1.4, 2.4}, 0.4F);  // a kiosk
        add_bin(scene, {.at = {x + 1.8, 3.2}});
        add_block(scene, {.at = {x, -2.9}}, {1.2, 0.9, 1.1}, 0.4F);
    }
}

/// Lines of people, each with its speed. They walk on beyond the end of the recording.
std::vector<Walker> lines(int pedestrians, Random& random) {
    std::vector<Walker> walkers;
    const int longest = (pedestrians + 3) / 4;
    const double spacing = std::min(1.5, 30.0 / std::max(longest, 1));
    for (int line = 0; line < 4; ++line) {
        const double speed = about(speeds[line], random);
        const double y = first_line + between_lines * line;
        const double way = line % 2 == 0 ? 1.0 : -1.0;
        const double front = -way * random.uniform(0.0, 4.0);
        for (int i = line; i < pedestrians; i += 4) {
            Walker walker = draw_walker(random);
            const double x = front - way * spacing * (i / 4);
            walker.speed = speed;
            walker.company = line;
            walker.start = {x, y};
            walker.route = {{.at = {x + 30.0 * way, y}}, {.at = walker.start}};
            walkers.push_back(walker);
        }
    }
    return walkers;
}

Vehicle creeping(VehicleKind kind, const Vector2d& from, const Vector2d& to, double speed,
                 Random& random) {
    return {.kind = kind,
            .ride = {.path = polyline({from, to}), .speed = about(speed, random)},
            .brightness = static_cast<float>(random.uniform(0.5, 1.4))};
}

/// A lane of vehicles, slower from front to back, so that none comes too close; the gate and the
/// load.
void add_vehicles(Scene& scene, Random& random) {
    for (int i = 0; i < 4; ++i) {
        const VehicleKind kind = i == 1 ? VehicleKind::van : VehicleKind::car;
        const double x = -19.0 + 7.0 * i + random.uniform(-0.4, 0.4);
        scene.vehicles.push_back(creeping(kind, {x, lane}, {60.0, lane}, speeds[i], random));
    }
    const double slide = speeds[random.below(4)], carry = speeds[random.below(4)];
    scene.vehicles.push_back(
        creeping(VehicleKind::gate, {-25.0, -9.0}, {-25.0, 40.0}, slide, random));
    scene.vehicles.push_back(
        creeping(VehicleKind::load, {26.2, 8.0}, {26.2, -40.0}, carry, random));
}

}  // namespace
}  // namespace slow

Scene slow_scene(int pedestrians, std::uint64_t seed) {
    using namespace slow;
    Scene scene;
    scene.low = {-half_length - 10.0, -half_width};
    scene.high = {half_length + 10.0, half_width};
    scene.floor = 0.05;
    Random random{hash(seed, 0x510)};
    add_shell(scene, random);
    add_still(scene, random);
    add_vehicles(scene, random);
    scene.walkers = lines(pedestrians, random);
    scene.robot = {.path = stadium(12.0, 1.6, random.uniform(-12.0, 12.0)), .speed = 0.9};
    scene.sensor_height = 0.82;
    scene.duration = 60.0;
    return scene;
}

}  // namespace dynamic_filter::sim
