// SPDX-License-Identifier: MIT
#include "sim/props.hpp"

#include "sim/prototypes.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {
namespace {

using Eigen::Affine3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr Material concrete = 0.35F, wood = 0.3F, steel = 0.4F;
constexpr Material trunk_wood(0.3F, Kind::thin), pole(0.4F, Kind::thin), plate(0.9F, Kind::thin);
constexpr Material leaf(0.45F, Kind::vegetation);

Affine3d frame(const Spot& spot) {
    Affine3d T = Affine3d::Identity();
    T.linear() << spot.axis.x(), -spot.axis.y(), 0, spot.axis.y(), spot.axis.x(), 0, 0, 0, 1;
    T.translation() = Vector3d(spot.at.x(), spot.at.y(), spot.z);
    return T;
}

void block_disc(Scene& scene, const Spot& spot, double radius) {
    scene.obstacles.push_back({.centre = spot.at, .radius = radius});
}

void block_rectangle(Scene& scene, const Spot& spot, double length, double width) {
    scene.obstacles.push_back(
        {.centre = spot.at, .half = {length / 2, width / 2}, .axis = spot.axis});
}

/// A box at a spot, from the corner `low` to the corner `high`.
void box(Scene& scene, const Spot& spot, const Vector3d& low, const Vector3d& high,
         Material material) {
    add_box(scene.still, frame(spot), {low, high}, material);
}

}  // namespace

std::vector<double> row(double first, double end, double step) {
    std::vector<double> out;
    for (int i = 0; first + step * i < end; ++i) out.push_back(first + step * i);
    return out;
}

void add_ground(Scene& scene, const Eigen::AlignedBox2d& area, double z, float reflectivity) {
    const Vector2d size = area.sizes();
    add_quad(scene.still, {area.min().x(), area.min().y(), z}, {size.x(), 0, 0}, {0, size.y(), 0},
             {reflectivity, Kind::ground});
}

void add_block(Scene& scene, const Spot& spot, const Vector3d& size, float reflectivity) {
    box(scene, spot, {-size.x() / 2, -size.y() / 2, 0}, {size.x() / 2, size.y() / 2, size.z()},
        reflectivity);
    block_rectangle(scene, spot, size.x(), size.y());
}

void add_column(Scene& scene, const Spot& spot, double radius, double height) {
    add_lathe(scene.still, frame(spot),
              {{1.3 * radius, 0},
               {1.3 * radius, 0.3},
               {radius, 0.35},
               {radius, height - 0.4},
               {1.4 * radius, height - 0.3},
               {1.4 * radius, height}},
              16, concrete);
    block_disc(scene, spot, 1.3 * radius);
}

void add_bench(Scene& scene, const Spot& spot) {
    box(scene, spot, {-0.9, -0.22, 0.40}, {0.9, 0.22, 0.46}, wood);
    box(scene, spot, {-0.9, 0.20, 0.55}, {0.9, 0.25, 0.90}, wood);
    for (const double x : {-0.75, 0.75}) {
        box(scene, spot, {x - 0.03, -0.2, 0}, {x + 0.03, 0.2, 0.40}, steel);
        box(scene, spot, {x - 0.03, 0.2, 0}, {x + 0.03, 0.25, 0.6}, steel);
    }
    block_rectangle(scene, spot, 1.8, 0.5);
}

void add_planter(Scene& scene, const Spot& spot, std::uint64_t seed) {
    box(scene, spot, {-0.6, -0.35, 0}, {0.6, 0.35, 0.55}, concrete);
    add_leaves(scene.still,
               {.centre = {spot.at.x(), spot.at.y(), spot.z + 0.85},
                .radii = {0.5, 0.35, 0.45},
                .leaves = 350,
                .leaf_size = 0.12,
                .seed = seed},
               leaf);
    block_rectangle(scene, spot, 1.2, 0.7);
}

void add_sign(Scene& scene, const Spot& spot) {
    add_lathe(scene.still, frame(spot), {{0.04, 0}, {0.04, 2.9}}, 8, pole);
    box(scene, spot, {-0.35, -0.06, 2.1}, {0.35, -0.04, 2.9}, plate);
    block_disc(scene, spot, 0.06);
}

void add_railing(Scene& scene, const Spot& spot, double length) {
    const double end = length / 2;
    box(scene, spot, {-end, -0.02, 0.96}, {end, 0.02, 1.02}, pole);
    for (const double x : {-end, 0.0})
        box(scene, spot, {x, -0.03, 0.0}, {x + 0.06, 0.03, 1.0}, pole);
    block_rectangle(scene, spot, length, 0.06);
}

void add_bin(Scene& scene, const Spot& spot) {
    add_lathe(scene.still, frame(spot), {{0.2, 0}, {0.24, 0.85}, {0.2, 0.95}}, 12, steel);
    block_disc(scene, spot, 0.25);
}

void add_lamp(Scene& scene, const Spot& spot, double height) {
    add_lathe(scene.still, frame(spot), {{0.12, 0}, {0.12, 0.8}, {0.07, 0.85}, {0.05, height}}, 10,
              pole);
    box(scene, spot, {-0.1, -0.1, height}, {0.9, 0.1, height + 0.12}, pole);
    block_disc(scene, spot, 0.13);
}

void add_tree(Scene& scene, const Spot& spot, double height, std::uint64_t seed) {
    Random random{hash(seed, 0x73ee)};
    const double trunk = 0.025 * height + 0.05;
    const double fork = 0.42 * height;
    add_lathe(scene.still, frame(spot),
              {{1.4 * trunk, 0}, {trunk, 0.4}, {0.8 * trunk, fork}, {0.3 * trunk, 0.8 * height}},
              10, trunk_wood);
    const double spread = 0.28 * height;
    for (int i = 0; i < 4; ++i) {  // boughs, each with a part of the crown
        const Vector3d root(spot.at.x(), spot.at.y(), spot.z + fork * random.uniform(0.85, 1.1));
        const double across = (i < 2 ? 1 : -1) * random.uniform(0.2, 0.6) * spread;
        const double along = (i % 2 == 0 ? 1 : -1) * random.uniform(0.2, 0.6) * spread;
        const Vector3d tip = root + Vector3d(along, across, 0.28 * height);
        add_capsule(scene.still, root, tip, 0.35 * trunk, trunk_wood);
        const double size = random.uniform(0.7, 0.9) * spread;
        add_leaves(scene.still,
                   {.centre = tip,
                    .radii = {size, size, 0.8 * size},
                    .leaves = 900,
                    .leaf_size = 0.16,
                    .seed = random.bits()},
                   leaf);
    }
    block_disc(scene, spot, 1.4 * trunk);
}

void add_parked_car(Scene& scene, const Spot& spot, float brightness) {
    Mesh mesh = car_mesh();
    for (Material& material : mesh.materials) material.reflectivity *= brightness;
    append(scene.still, mesh, frame(spot));
    block_rectangle(scene, spot, 4.3, 1.8);
}

}  // namespace dynamic_filter::sim
