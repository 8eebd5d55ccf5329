// SPDX-License-Identifier: MIT
/// A hall of 48 m x 26 m on two levels: shops along the nave, galleries with more people above
/// them, stairs, columns and a roof. The robot drives along the nave.
#include <cmath>

#include "sim/people.hpp"
#include "sim/props.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {
namespace hall {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double half_length = 24.0, half_width = 13.0, roof = 9.0;
constexpr double edge = 8.0;   ///< [m] distance of the galleries from the middle
constexpr double level = 4.0;  ///< [m] height of the floor of the galleries
constexpr double front = 9.0;  ///< [m] the shops below are a little farther back

void add_slab(Scene& scene, const Eigen::AlignedBox3d& slab) {
    const std::size_t first = scene.still.triangles.size();
    add_box(scene.still, Eigen::Affine3d::Identity(), slab, 0.35F);
    pave(scene.still, first);
}

void add_shops(Scene& scene, double side, double at, double z, std::uint64_t seed) {
    Random random{hash(seed, side > 0.0 ? 0x11 : 0x12, z > 0.0 ? 1 : 0)};
    Facade facade{.spot = {.at = {-side * half_length, side * at}, .axis = {side, 0.0}, .z = z},
                  .bays = {},
                  .bay_width = 4.0,
                  .upper_floors = 0,
                  .seed = random.bits()};
    const Bay kinds[] = {Bay::shop, Bay::shop, Bay::recess, Bay::wall};
    for (int i = 0; i < 12; ++i) facade.bays.push_back(kinds[random.below(4)]);
    add_facade(scene, facade);
}

/// Stairs along the edge of the gallery, from the nave to the gallery.
void add_stairs(Scene& scene, double side) {
    constexpr int steps = 20;
    for (int i = 0; i < steps; ++i) {
        const Spot spot{.at = {side * (-18.0 + 0.3 * i), side * (edge - 1.1)}};
        add_block(scene, spot, {0.3, 1.6, level * (i + 1) / steps}, 0.35F);
    }
}

void add_side(Scene& scene, double side, std::uint64_t seed) {
    const double low = std::min(side * edge, side * half_width);
    const double high = std::max(side * edge, side * half_width);
    add_slab(scene, {Eigen::Vector3d(-half_length, low, level - 0.35),
                     Eigen::Vector3d(half_length, high, level)});
    const std::size_t people_meet = scene.obstacles.size();
    add_shops(scene, side, front, 0.0, seed);  // nobody walks below the gallery
    scene.obstacles.resize(people_meet);  // people on the gallery do not meet the obstacles below
    add_shops(scene, side, half_width, level, seed);
    for (const double x : row(-22.0, 23.0, 4.0)) {
        add_railing(scene, {.at = {x, side * (edge + 0.1)}, .z = level}, 4.0);
        if (std::fmod(x + 22.0, 8.0) < 1.0) {
            add_column(scene, {.at = {x, side * (edge + 0.25)}}, 0.2, level - 0.35);
        }
    }
    scene.obstacles.push_back({.centre = {0.0, side * edge}, .half = {half_length, 0.2}});
    add_stairs(scene, side);
}

void add_furniture(Scene& scene, std::uint64_t seed) {
    Random random{hash(seed, 0x13)};
    for (const double x : {-16.0, -6.0, 5.0, 15.0}) {
        const double y = random.uniform(2.2, 3.6);
        add_bench(scene, {.at = {x, y}});
        add_planter(scene, {.at = {x + 2.4, y}}, random.bits());
        add_bin(scene, {.at = {x - 2.0, y}});
        add_sign(scene, {.at = {x + random.uniform(3.5, 4.5), -4.5}, .axis = {0.0, 1.0}});
        add_bench(scene, {.at = {x, 11.8}, .z = level});
        add_planter(scene, {.at = {x + 3.0, -11.8}, .z = level}, random.bits());
    }
}

/// A part of the hall for some of the people: between two y, from wall to wall.
struct Floor {
    double low, high;
};

/// A few places of a floor; each is reached on a straight line from the previous one.
std::vector<Waypoint> route(const Floor& floor, const DistanceField& field, Random& random) {
    std::vector<Waypoint> out;
    for (int attempt = 0; attempt < 4000 && out.size() < 6; ++attempt) {
        const double y = random.uniform(floor.low, floor.high);
        const Vector2d p(random.uniform(-23.0, 23.0), y);
        if (field.at(p).distance < 0.6) continue;
        if (!out.empty()) {
            if ((p - out.back().at).norm() < 5.0 || !is_clear(field, out.back().at, p, 0.4))
                continue;
            if (out.size() == 5 && !is_clear(field, p, out.front().at, 0.4)) continue;
        }
        out.push_back(
            {.at = p, .reach = 0.8, .pause = random.chance(0.15) ? random.uniform(3.0, 8.0) : 0.0});
    }
    return out;
}

void add_people(Scene& scene, int pedestrians, std::uint64_t seed) {
    Random random{hash(seed, 0x14)};
    const DistanceField field = distance_field(scene.obstacles, scene.low, scene.high);
    const Floor nave{-edge + 0.8, edge - 0.8};
    const Floor galleries[] = {{edge + 0.6, half_width - 0.6}, {-half_width + 0.6, -edge - 0.6}};
    for (int i = 0; i < pedestrians; ++i) {
        Walker walker = draw_walker(random);
        // A third of the people is upstairs.
        const Floor& floor = i % 3 != 2 ? nave : galleries[(i / 3) % 2];
        while (walker.route.size() < 3) walker.route = route(floor, field, random);
        scene.walkers.push_back(walker);
    }
    scatter(scene.walkers, field, random);
}

}  // namespace
}  // namespace hall

Scene hall_scene(int pedestrians, std::uint64_t seed) {
    using namespace hall;
    Scene scene;
    scene.low = {-half_length, -half_width};
    scene.high = {half_length, half_width};
    scene.floor = 0.05;
    scene.ground = [](const Vector2d& p) { return std::abs(p.y()) > edge ? level : 0.0; };
    add_ground(scene, AlignedBox2d(Vector2d(-half_length, -13), Vector2d(half_length, 13)), 0.0,
               0.3F);
    add_box(scene.still, Eigen::Affine3d::Identity(),
            {Eigen::Vector3d(-half_length, -half_width, roof),
             Eigen::Vector3d(half_length, half_width, roof + 0.3)},
            0.5F);
    for (const double end : {-1.0, 1.0}) {
        add_block(scene, {.at = {end * (half_length + 0.2), 0.0}}, {0.4, 2.0 * half_width, roof},
                  0.5F);
        add_block(scene, {.at = {0.0, end * (half_width + 3.0)}}, {2.0 * half_length, 0.4, roof},
                  0.5F);
        add_side(scene, end, seed);
    }
    add_furniture(scene, seed);
    add_people(scene, pedestrians, seed);
    scene.robot = {
        .path = smooth_path(
            {{-21, -2}, {-14, -1}, {-6, 0.5}, {2, -1.5}, {10, 0}, {16, -1}, {22, 0}}, false),
        .start = 1.0,
        .speed = 1.2};
    scene.sensor_height = 0.8;
    scene.duration = 30.0;
    return scene;
}

}  // namespace dynamic_filter::sim
