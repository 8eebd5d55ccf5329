// SPDX-License-Identifier: MIT
/// A hall of 40 m x 14 m with mirrors: a front of coated glass along one side, shops behind clear
/// panes along the other, polished doors of lifts at one end, an open doorway at the other, and a
/// wall in the middle with a mirror on one side. The robot drives along the front and back behind
/// that wall. People walk and stand before the mirrors.
#include <algorithm>

#include "sim/people.hpp"
#include "sim/props.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {
namespace mirrors {
namespace {

using Eigen::Affine3d;
using Eigen::AlignedBox2d;
using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double half_length = 20.0, half_width = 7.0, ceiling = 4.0;  // [m]
constexpr double bay = 2.5;                                            ///< [m] of the glass front
constexpr double partition_y = 2.4, partition_half = 5.0;              // [m]
constexpr Material coated(0.002F, Kind::structure, {.reflects = 0.5F, .transmits = 0.0F});
constexpr Material clear(0.002F, Kind::structure, {.reflects = 0.08F, .transmits = 0.9F});
constexpr Material polished(0.004F, Kind::structure, {.reflects = 0.8F, .transmits = 0.0F});
constexpr float plaster = 0.5F, metal = 0.4F;

void box(Scene& scene, const Vector3d& low, const Vector3d& high) {
    add_box(scene.still, Affine3d::Identity(), AlignedBox3d(low, high), metal);
}

void add_wall(Scene& scene, const Vector2d& low, const Vector2d& high) {
    const Vector2d size = high - low;
    add_block(scene, {.at = (low + high) / 2}, {size.x(), size.y(), ceiling}, plaster);
}

/// Panes of coated glass in frames, on a wall; some bays are plain wall.
void add_front(Scene& scene, Random& random) {
    const double y = -half_width;
    add_wall(scene, {-half_length, y - 0.4}, {half_length, y - 0.04});
    for (const double x : row(-17.5, 17.0, bay)) {
        box(scene, {x - 0.05, y - 0.04, 0.0}, {x + 0.05, y + 0.08, 2.8});
        if (random.chance(0.2)) continue;
        box(scene, {x, y - 0.04, 0.0}, {x + bay, y + 0.06, 0.3});
        box(scene, {x, y - 0.04, 2.7}, {x + bay, y + 0.06, 2.8});
        add_quad(scene.still, {x, y, 0.3}, {bay, 0, 0}, {0, 0, 2.4}, coated);
    }
}

/// Shops on the other side; most of them have panes.
void add_shops(Scene& scene, Random& random) {
    Facade shops{.spot = {.at = {-half_length, half_width}, .axis = {1.0, 0.0}},
                 .bays = {},
                 .bay_width = 4.0,
                 .upper_floors = 0,
                 .seed = random.bits()};
    for (int i = 0; i < 10; ++i) {
        const Bay kinds[] = {Bay::shop, Bay::shop, Bay::shop, Bay::recess, Bay::wall};
        shops.bays.push_back(kinds[random.below(5)]);
        if (shops.bays.back() != Bay::shop || random.chance(0.3)) continue;
        add_quad(scene.still, {-half_length + 4.0 * i, half_width + 0.06, 0.45}, {4.0, 0, 0},
                 {0, 0, 2.25}, clear);
    }
    add_facade(scene, shops);
    add_wall(scene, {-half_length, half_width + 3.0}, {half_length, half_width + 3.4});
}

/// A wall with the doors of three lifts.
void add_lifts(Scene& scene) {
    const double x = half_length;
    add_wall(scene, {x + 0.04, -half_width}, {x + 0.4, half_width});
    for (const double y : {-4.0, -0.8, 2.4}) {
        for (const double side : {-0.9, 0.9}) {
            box(scene, {x - 0.06, y + side - 0.06, 0.0}, {x + 0.04, y + side + 0.06, 2.3});
        }
        box(scene, {x - 0.06, y - 0.9, 2.2}, {x + 0.04, y + 0.9, 2.3});
        add_quad(scene.still, {x, y - 0.84, 0.0}, {0, 1.68, 0}, {0, 0, 2.2}, polished);
    }
}

/// A wall with an open doorway, and the room behind it.
void add_doorway(Scene& scene) {
    const double x = -half_length, back = x - 5.0;
    add_wall(scene, {x - 0.3, -half_width}, {x, -3.0});
    add_wall(scene, {x - 0.3, -0.6}, {x, half_width});
    add_wall(scene, {back - 0.3, -half_width}, {back, half_width});
    for (const double side : {-1.0, 1.0}) {
        add_wall(scene, {back, std::min(side * 6.0, side * 6.3)},
                 {x - 0.3, std::max(side * 6.0, side * 6.3)});
    }
    add_bench(scene, {.at = {back + 1.2, -1.0}, .axis = {0.0, 1.0}});
    add_bin(scene, {.at = {back + 3.0, -4.2}});
    add_column(scene, {.at = {back + 2.6, -2.9}}, 0.25, ceiling);
}

void add_partition(Scene& scene) {
    const double y = partition_y, top = 2.6;
    const Spot middle{.at = {0.0, y + 0.12}};
    add_block(scene, middle, {2.0 * partition_half, 0.2, top}, plaster);
    add_quad(scene.still, {-partition_half, y, 0.1}, {2.0 * partition_half, 0, 0},
             {0, 0, top - 0.2}, polished);
    for (const double x : {-partition_half, 0.0, partition_half}) {
        box(scene, {x - 0.05, y - 0.05, 0.0}, {x + 0.05, y + 0.05, top});
    }
    box(scene, {-partition_half, y - 0.05, top - 0.1}, {partition_half, y + 0.05, top});
}

void add_furniture(Scene& scene, Random& random) {
    for (const double x : row(-15.0, 16.0, 5.0)) {
        const double at = x + random.uniform(-1.0, 1.0);
        add_bench(scene, {.at = {at, -5.4 + random.uniform(0.0, 0.6)}});
        if (random.chance(0.6)) add_planter(scene, {.at = {at + 2.3, -5.0}}, random.bits());
        if (random.chance(0.6) && x < 12.0) add_bin(scene, {.at = {at - 1.8, 0.6}});
        if (random.chance(0.5)) add_sign(scene, {.at = {at + 1.0, 1.2}, .axis = {0.0, 1.0}});
    }
    for (const double x : {-11.0, -7.5, 8.0}) {
        add_column(scene, {.at = {x + random.uniform(-0.5, 0.5), 1.8}}, 0.22, ceiling);
    }
}

/// A few places of the hall; each is reached on a straight line from the one before it.
std::vector<Waypoint> route(const DistanceField& field, bool stands, Random& random) {
    std::vector<Waypoint> out;
    for (int attempt = 0; attempt < 4000 && out.size() < 6; ++attempt) {
        const double y = random.uniform(-6.2, 6.2);
        const Vector2d p(random.uniform(-18.0, 18.0), y);
        if (field.at(p).distance < 0.5) continue;
        if (!out.empty()) {
            if ((p - out.back().at).norm() < 3.0 || !is_clear(field, out.back().at, p, 0.4))
                continue;
            if (out.size() == 5 && !is_clear(field, p, out.front().at, 0.4)) continue;
        }
        const double pause = stands                ? random.uniform(10.0, 30.0)
                             : random.chance(0.15) ? random.uniform(3.0, 8.0)
                                                   : 0.0;
        out.push_back({.at = p, .reach = 0.6, .pause = pause, .face = p - Vector2d(0.0, 1.0)});
    }
    return out;
}

void add_people(Scene& scene, int pedestrians, Random& random) {
    const DistanceField field = distance_field(scene.obstacles, scene.low, scene.high);
    for (int i = 0; i < pedestrians; ++i) {
        Walker walker = draw_walker(random);
        while (walker.route.size() < 3) walker.route = route(field, i % 3 == 0, random);
        scene.walkers.push_back(walker);
    }
    scatter(scene.walkers, field, random);
}

}  // namespace
}  // namespace mirrors

Scene mirrors_scene(int pedestrians, std::uint64_t seed) {
    using namespace mirrors;
    Scene scene;
    scene.low = {-half_length - 6.0, -half_width};
    scene.high = {half_length, half_width};
    scene.floor = 0.05;
    const Vector2d low(-half_length - 5.0, -half_width), high(half_length, half_width + 3.0);
    add_ground(scene, AlignedBox2d(low, high), 0.0, 0.3F);
    box(scene, {low.x(), low.y(), ceiling}, {high.x(), high.y(), ceiling + 0.3});
    Random random{hash(seed, 0x3117)};
    add_front(scene, random);
    add_shops(scene, random);
    add_lifts(scene);
    add_doorway(scene);
    add_partition(scene);
    add_furniture(scene, random);
    add_people(scene, pedestrians, random);
    scene.robot = {.path = smooth_path({{-17, -2},
                                        {-8, -2.6},
                                        {0, -1.6},
                                        {8, -2.8},
                                        {13, -1},
                                        {14, 2},
                                        {11, 4.4},
                                        {4, 4.7},
                                        {-6, 4.3},
                                        {-14, 4.2}},
                                       false),
                   .start = 1.0,
                   .speed = 1.2};
    scene.sensor_height = 0.82;
    scene.duration = 48.0;
    return scene;
}

}  // namespace dynamic_filter::sim
