// SPDX-License-Identifier: MIT
#include <algorithm>

#include "sim/prototypes.hpp"

namespace dynamic_filter::sim {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

/// A wall of a wagon along x with sill, windows and lintel; with open doorways if `doors` is set.
void add_wagon_side(Mesh& mesh, double y, bool doors) {
    const auto wall = [&](double x0, double x1, double z0, double z1) {
        add_box(mesh, Affine3d::Identity(),
                {Vector3d(x0, y - 0.04, z0), Vector3d(x1, y + 0.04, z1)}, paint);
    };
    wall(-wagon_half_length, wagon_half_length, 2.05, 2.45);
    double from = -wagon_half_length;
    for (const double door : wagon_doors) {
        const double to = doors ? door - door_leaf : door;
        wall(from, to, 0.0, 0.95);
        for (const double x : {from, 0.5 * (from + to) - 0.1, to - 0.2})
            wall(x, x + 0.2, 0.95, 2.05);
        from = doors ? door + door_leaf : door;
    }
    wall(from, wagon_half_length, 0.0, 0.95);
    for (const double x : {from, wagon_half_length - 0.2}) wall(x, x + 0.2, 0.95, 2.05);
}

}  // namespace

Mesh wagon_mesh() {
    Mesh mesh;
    const double length = wagon_half_length, width = wagon_half_width;
    const auto box = [&](const Vector3d& low, const Vector3d& high, float reflectivity) {
        add_box(mesh, Affine3d::Identity(), {low, high}, reflectivity);
    };
    box({-length, -width, -0.15}, {length, width, -0.01}, metal);
    box({-length, -width, 2.45}, {length, width, 2.7}, paint);
    for (const double end : {-1.0, 1.0})
        box({end * length - 0.05, -width, 0.0}, {end * length + 0.05, width, 2.45}, paint);
    for (const double x : {-6.5, 0.0, 6.5})  // bogies, and the equipment between them
        box({x - 1.6, -1.1, -0.95}, {x + 1.6, 1.1, -0.15}, metal);
    add_wagon_side(mesh, -width, true);
    add_wagon_side(mesh, width, false);
    for (const double x : {-8.2, -3.0, 3.0, 8.2})  // seats along the far side
        box({x - 0.9, 0.85, 0.0}, {x + 0.9, 1.3, 0.45}, cloth);
    return mesh;
}

Mesh doors_mesh(double forward) {
    Mesh mesh;
    const double y = -wagon_half_width - 0.07;
    for (const double door : wagon_doors) {
        const double x0 = std::min(door, door + forward * door_leaf);
        const double x1 = x0 + door_leaf;
        add_box(mesh, shift(0, y, 0), {Vector3d(x0, -0.02, 0.02), Vector3d(x1, 0.02, 1.0)}, paint);
        add_box(mesh, shift(0, y, 0), {Vector3d(x0, -0.02, 1.8), Vector3d(x1, 0.02, 2.1)}, paint);
        for (const double x : {x0, x1 - 0.12})
            add_box(mesh, shift(0, y, 0), {Vector3d(x, -0.02, 1.0), Vector3d(x + 0.12, 0.02, 1.8)},
                    paint);
    }
    return mesh;
}

}  // namespace dynamic_filter::sim
