// SPDX-License-Identifier: MIT
/// A station platform, 72 m x 9 m. People stand for minutes, alone and in groups, with luggage. A
/// train arrives, people get off and on, and it leaves. The robot drives along the platform and
/// back.
#include <cmath>

#include "sim/platform.hpp"
#include "sim/props.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {
namespace platform {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double tunnel = 220.0, far_wall = 8.6;  // [m]

void add_wall(Scene& scene, double x0, double y0, double x1, double y1) {
    add_block(scene, {.at = {(x0 + x1) / 2, (y0 + y1) / 2}}, {x1 - x0, y1 - y0, ceiling}, 0.5F);
}

/// The track in its trough, from one tunnel to the other, and the roof.
void add_shell(Scene& scene) {
    const double end = exit_until + 0.3;
    add_ground(scene, AlignedBox2d(Vector2d(-end, -half_width), Vector2d(end, half_width)), 0.0,
               0.3F);
    add_ground(scene, AlignedBox2d(Vector2d(-tunnel, half_width), Vector2d(tunnel, far_wall)),
               track, 0.2F);
    add_quad(scene.still, {-end, half_width, track}, {2 * end, 0, 0}, {0, 0, -track}, 0.35F);
    add_quad(scene.still, {-tunnel, far_wall, track}, {2 * tunnel, 0, 0}, {0, 0, ceiling - track},
             0.4F);
    add_quad(scene.still, {-tunnel, -half_width, ceiling}, {2 * tunnel, 0, 0},
             {0, far_wall + half_width, 0}, 0.5F);
    for (const double side : {-1.0, 1.0}) {
        const double x = side > 0.0 ? end : -tunnel;
        add_quad(scene.still, {x, half_width, track}, {tunnel - end, 0, 0}, {0, 0, ceiling - track},
                 0.4F);
    }
    for (const double rail : {-0.72, 0.72}) {
        const Spot spot{.at = {0.0, train_y + rail}, .z = track};
        const std::size_t still = scene.obstacles.size();
        add_block(scene, spot, {2 * tunnel, 0.07, 0.15}, 0.5F);
        scene.obstacles.resize(still);  // lower than the people
    }
}

/// The walls at the ends with the doorways of the exits, and the corridors behind them.
void add_exits(Scene& scene) {
    for (const double side : {-1.0, 1.0}) {
        const double x = side * (half_length + 0.15), back = side * (exit_until + 0.15);
        const double low = std::min(x, back), high = std::max(x, back);
        add_wall(scene, x - 0.15, -half_width, x + 0.15, -2.8);
        add_wall(scene, x - 0.15, -1.0, x + 0.15, half_width);
        add_wall(scene, back - 0.15, -half_width, back + 0.15, half_width);
        add_wall(scene, low, 1.2, high, 1.5);
        // Stairs beside the doorway, behind a wall.
        for (int i = 0; i < 14; ++i) {
            const Spot step{.at = {side * (half_length - 6.0 + 0.32 * i), -3.9}};
            const std::size_t first = scene.still.triangles.size();
            add_block(scene, step, {0.32, 1.2, 0.17 * (i + 1)}, 0.35F);
            pave(scene.still, first);
        }
    }
}

/// The wall along the platform, with niches, benches and machines.
void add_long_wall(Scene& scene, Random& random) {
    Facade wall{.spot = {.at = {half_length, -half_width}, .axis = {-1.0, 0.0}},
                .bays = {},
                .bay_width = 4.0,
                .ground_floor = ceiling - 0.2,
                .upper_floors = 0,
                .room_depth = 2.0,
                .seed = random.bits()};
    const Bay kinds[] = {Bay::wall, Bay::wall, Bay::recess, Bay::wall, Bay::shop};
    for (int i = 0; i < 18; ++i)
        wall.bays.push_back(i < 2 || i > 15 ? Bay::wall : kinds[random.below(5)]);
    add_facade(scene, wall);
    for (const double x : row(-26.0, 27.0, 6.5)) {
        const Spot spot{.at = {x + random.uniform(-1.0, 1.0), -half_width + 0.55},
                        .axis = {-1.0, 0.0}};
        switch (random.below(4)) {
            case 0:
                add_block(scene, spot, {1.1, 0.7, 1.85}, 0.4F);  // vending machine
                break;
            case 1:
                add_bin(scene, spot);
                break;
            default:
                add_bench(scene, spot);
                break;
        }
    }
}

/// Pillars, and objects between them.
void add_middle(Scene& scene, Random& random) {
    for (int i = -3; i <= 3; ++i) {
        const double x = pillars * i;
        add_column(scene, {.at = {x, 0.0}}, 0.3, ceiling);
        if (i == 3) continue;
        const double bench = x + 2.6 + random.uniform(-0.4, 0.4);
        add_bench(scene, {.at = {bench, 0.45}, .axis = {-1.0, 0.0}});
        add_bench(scene, {.at = {bench, -0.45}});
        if (random.chance(0.5)) add_bin(scene, {.at = {x + 4.4, 0.0}});
        if (random.chance(0.5)) add_sign(scene, {.at = {x + 0.8, 0.0}, .axis = {0.0, 1.0}});
    }
}

/// Obstacles that keep people on the platform and, in the train, off the track: the edge of the
/// platform between the doors, and the walls of the train.
void add_edge(Scene& scene) {
    double from = -half_length - 0.5;
    const auto keep = [&](double x0, double x1, double y, double half) {
        scene.obstacles.push_back({.centre = {(x0 + x1) / 2, y}, .half = {(x1 - x0) / 2, half}});
    };
    for (const double door : doors()) {
        keep(from, door - door_leaf, half_width + 0.06, 0.06);
        from = door + door_leaf;
    }
    keep(from, half_length + 0.5, half_width + 0.06, 0.06);
    keep(-half_length, half_length, train_y + 1.0, 0.15);
    for (const double wagon : {-1.5, -0.5, 0.5, 1.5})
        keep(wagon * wagon_pitch - 0.3, wagon * wagon_pitch + 0.3, train_y, 1.0);
}

}  // namespace

Train train(std::uint64_t seed) {
    Random random{hash(seed, 0x9a0)};
    const double comes = random.uniform(70.0, 95.0), stands = random.uniform(32.0, 40.0);
    const Path path = polyline({{-3000.0, train_y}, {0.0, train_y}, {3000.0, train_y}});
    Train out;
    for (const double wagon : {wagon_pitch, 0.0, -wagon_pitch}) {
        Ride ride{.path = path, .speed = 13.0, .stop_at = 3000.0 + wagon, .stop_time = stands};
        ride.start = ride.stop_at - 1.0;
        ride.start -= ride.speed * (comes - halts_at(ride));
        out.wagons.push_back({.kind = VehicleKind::wagon, .ride = ride, .brightness = 1.1F});
    }
    out.timetable = {comes + 2.5, comes + stands - 2.5};
    return out;
}

}  // namespace platform

Scene platform_scene(int pedestrians, std::uint64_t seed) {
    using namespace platform;
    Scene scene;
    scene.low = {-exit_until - 1.0, -half_width - 2.0};
    scene.high = {exit_until + 1.0, far_wall};
    scene.floor = 0.05;
    Random random{hash(seed, 0x9a2)};
    add_shell(scene);
    add_exits(scene);
    add_long_wall(scene, random);
    add_middle(scene, random);
    add_edge(scene);
    const Train train = platform::train(seed);
    scene.vehicles = train.wagons;
    scene.carried = [wagon = train.wagons[1].ride](const Vector2d& p, double t) -> Vector2d {
        if (p.y() < aboard) return Vector2d::Zero();
        return {travelled(wagon, t) - wagon.stop_at, 0.0};
    };
    scene.walkers = people(pedestrians, train.timetable, seed);
    scene.robot = {.path = stadium(half_length - 7.0, platform::leg, random.uniform(-26.0, -10.0)),
                   .speed = 0.6};
    scene.sensor_height = 0.82;
    scene.duration = std::floor(scene.robot.path.lengths.back() / scene.robot.speed);
    return scene;
}

}  // namespace dynamic_filter::sim
