// SPDX-License-Identifier: MIT
/// An open square, 60 m x 60 m, with a fountain, trees, and a stage with steps and a ramp. People
/// cross it in all directions while the robot drives a slow curve.
#include <cmath>
#include <numbers>

#include "sim/people.hpp"
#include "sim/portable.hpp"
#include "sim/props.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {
namespace square {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double half = 30.0;
constexpr double clearing = 3.0;  // [m] half the width of the streets at the corners

void add_buildings(Scene& scene, std::uint64_t seed) {
    Random random{hash(seed, 0x5a)};
    const Vector2d axes[] = {{1, 0}, {0, -1}, {-1, 0}, {0, 1}};
    for (const Vector2d& axis : axes) {
        const Vector2d out(-axis.y(), axis.x());  // direction into the house
        Facade facade{.spot = {.at = half * out - (half - clearing) * axis, .axis = axis},
                      .bays = {},
                      .bay_width = 4.5,
                      .upper_floors = 3,
                      .seed = random.bits()};
        const Bay kinds[] = {Bay::wall, Bay::shop, Bay::recess, Bay::shop, Bay::wall};
        for (int i = 0; i < 12; ++i) facade.bays.push_back(kinds[random.below(5)]);
        add_facade(scene, facade);
    }
}

/// A basin with a pillar and a figure.
void add_fountain(Scene& scene) {
    Eigen::Affine3d T = Eigen::Affine3d::Identity();
    add_lathe(scene.still, T,
              {{3.2, 0},
               {3.2, 0.45},
               {2.9, 0.5},
               {2.8, 0.3},
               {0.6, 0.25},
               {0.5, 1.6},
               {1.2, 1.8},
               {1.2, 1.95},
               {0.3, 2.0},
               {0.25, 2.6},
               {0.35, 3.2},
               {0.15, 3.5},
               {0.2, 3.8},
               {0.05, 4.0}},
              24, 0.4F);
    scene.obstacles.push_back({.centre = Vector2d::Zero(), .radius = 3.3});
}

/// A stage with five steps, and a ramp at its side.
void add_stage(Scene& scene) {
    const Vector2d middle(17.0, 18.0);
    const std::size_t first = scene.still.triangles.size();
    for (int i = 0; i < 5; ++i) {
        const double depth = 6.0 - 0.7 * i;
        add_block(scene, {.at = middle + Vector2d(0.0, 0.35 * i)}, {9.0, depth, 0.16 * (i + 1)},
                  0.35F);
    }
    add_prism(scene.still,
              Eigen::Affine3d(Eigen::Translation3d(middle.x() + 5.4, middle.y() + 1.4, 0.0)) *
                  Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitZ()),
              {{-6.5, 0.0}, {1.5, 0.0}, {1.5, 0.8}, {0.5, 0.8}}, 0.9, 0.35F);
    pave(scene.still, first);
    scene.obstacles.push_back({.centre = middle + Vector2d(5.4, -1.1), .half = {0.9, 4.0}});
}

void add_furniture(Scene& scene, std::uint64_t seed) {
    Random random{hash(seed, 0x5b)};
    for (const double x : {-20.0, -12.0, 12.0, 20.0}) {
        for (const double y : {-20.0, -9.0, 9.0, 20.0}) {
            if (x > 0.0 && y > 0.0 && (x > 15.0 || y > 15.0)) continue;  // place of the stage
            const double off = random.uniform(-1.0, 1.0);
            const Vector2d at(x + random.uniform(-1.0, 1.0), y + off);
            const std::uint64_t shape = random.bits();
            add_tree(scene, {.at = at}, random.uniform(5.5, 8.5), shape);
            if (random.chance(0.6))
                add_bench(scene, {.at = at + Vector2d(0.0, 1.4), .axis = {-1.0, 0.0}});
        }
    }
    for (int i = 0; i < 8; ++i) {
        const SinCos a = portable_sincos(std::numbers::pi * (i + 0.5) / 4.0);
        const Spot spot{.at = 6.0 * Vector2d(a.cos, a.sin), .axis = {-a.sin, a.cos}};
        if (i % 2 == 0) add_bench(scene, {.at = spot.at, .axis = -spot.axis});
        if (i % 4 == 1) add_planter(scene, spot, random.bits());
        if (i % 4 == 3) add_lamp(scene, spot, 5.0);
    }
    for (const double y : {-24.0, -6.0, 6.0, 24.0}) {
        add_bin(scene, {.at = {-25.0, y}});
        add_sign(scene, {.at = {25.5, y}, .axis = {0.0, 1.0}});
        add_lamp(scene, {.at = {y, -25.5}, .axis = {0.0, 1.0}}, 5.0);
    }
}

/// A few places on the square; each is reached on a straight line from the previous one.
std::vector<Waypoint> route(const DistanceField& field, Random& random) {
    std::vector<Waypoint> out;
    for (int attempt = 0; attempt < 4000 && out.size() < 7; ++attempt) {
        const double y = random.uniform(-27.0, 27.0);
        const Vector2d p(random.uniform(-27.0, 27.0), y);
        if (field.at(p).distance < 0.8) continue;
        if (!out.empty()) {
            const double length = (p - out.back().at).norm();
            if (length < 8.0 || !is_clear(field, out.back().at, p, 0.5)) continue;
            if (out.size() == 6 && !is_clear(field, p, out.front().at, 0.5)) continue;
        }
        out.push_back(
            {.at = p, .reach = 1.0, .pause = random.chance(0.1) ? random.uniform(3.0, 8.0) : 0.0});
    }
    return out;
}

void add_vehicles(Scene& scene) {
    const Path lane = smooth_path({{-28.4, 60.0},
                                   {-28.4, 30.0},
                                   {-27.3, 15.0},
                                   {-27.3, 0.0},
                                   {-27.3, -15.0},
                                   {-28.4, -30.0},
                                   {-28.4, -60.0}},
                                  false);
    double stop = 0.0;
    while (at(lane, stop).position.y() > 2.0) stop += 0.1;
    scene.vehicles.push_back({.kind = VehicleKind::van,
                              .ride = {.path = lane,
                                       .start = stop - 24.0,
                                       .speed = 3.5,
                                       .stop_at = stop,
                                       .stop_time = 12.0}});
    // Around the trees in the north-west and in the south-east.
    const auto cyclist = [&](const std::vector<Vector2d>& corners, double start, double speed) {
        scene.vehicles.push_back(
            {.kind = VehicleKind::cyclist,
             .ride = {.path = smooth_path(corners, true), .start = start, .speed = speed}});
    };
    cyclist({{-16, 25}, {-16, 15}, {-3, 15}, {10, 15}, {10, 25}, {-3, 25}}, 10.0, 3.0);
    cyclist({{16, -4}, {16, -14}, {16, -23.5}, {24, -23.5}, {24, -14}, {24, -4}}, 0.0, 2.6);
}

}  // namespace
}  // namespace square

Scene square_scene(int pedestrians, std::uint64_t seed) {
    using namespace square;
    Scene scene;
    scene.low = {-half, -half};
    scene.high = {half, half};
    scene.floor = 0.05;
    add_ground(scene, AlignedBox2d(Vector2d(-100, -100), Vector2d(100, 100)), 0.0, 0.3F);
    add_buildings(scene, seed);
    add_fountain(scene);
    add_stage(scene);
    add_furniture(scene, seed);
    add_vehicles(scene);

    Random random{hash(seed, 0x5c)};
    const DistanceField field = distance_field(scene.obstacles, scene.low, scene.high);
    int companies = 0;
    while (static_cast<int>(scene.walkers.size()) < pedestrians) {
        Walker walker = draw_walker(random);
        walker.route = route(field, random);
        const bool pair =
            random.chance(0.12) && static_cast<int>(scene.walkers.size()) + 2 <= pedestrians;
        if (pair) walker.company = companies++;
        scene.walkers.push_back(walker);
        if (pair) scene.walkers.push_back(companion(walker, 0.5, random));
    }
    scatter(scene.walkers, field, random);
    scene.robot = {.path = smooth_path({{-24, -17},
                                        {-20, -16},
                                        {-14, -14.5},
                                        {-8, -12},
                                        {-2, -9},
                                        {4, -8.5},
                                        {10, -5},
                                        {12, 0},
                                        {14, 8},
                                        {12, 14}},
                                       false),
                   .start = 1.0,
                   .speed = 1.0};
    scene.sensor_height = 0.8;
    scene.duration = 30.0;
    return scene;
}

}  // namespace dynamic_filter::sim
