// SPDX-License-Identifier: MIT
#include "sim/prototypes.hpp"

#include <numbers>

#include "sim/portable.hpp"

namespace dynamic_filter::sim {
namespace {

using Eigen::Affine3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr float skin = 0.5F, rubber = 0.08F;  // reflectivities

/// Upper body of a person of 1.75 m, from the hips up. The origin of the frame is on the ground
/// below the hips.
Mesh torso(bool with_pack) {
    Mesh mesh;
    const Affine3d flat = shift(0, 0, 0) * Eigen::Scaling(0.62, 1.0, 1.0);
    add_lathe(mesh, flat,
              {{0.09, 0.80},
               {0.17, 0.86},
               {0.175, 0.96},
               {0.15, 1.10},
               {0.18, 1.28},
               {0.20, 1.40},
               {0.16, 1.46},
               {0.06, 1.50}},
              12, cloth);
    add_lathe(mesh, shift(0.01, 0, 0), {{0.055, 1.46}, {0.055, 1.54}}, 8, skin);
    add_lathe(
        mesh, shift(0.02, 0, 0) * Eigen::Scaling(1.15, 0.9, 1.0),
        {{0.03, 1.51}, {0.07, 1.54}, {0.092, 1.60}, {0.095, 1.66}, {0.075, 1.72}, {0.03, 1.75}}, 10,
        skin);
    if (with_pack) {
        add_lathe(mesh, shift(-0.18, 0, 0) * Eigen::Scaling(0.65, 1.0, 1.0),
                  {{0.08, 1.02}, {0.15, 1.06}, {0.15, 1.34}, {0.08, 1.40}}, 8, cloth);
    }
    return mesh;
}

Mesh leg() {
    Mesh mesh;  // from the hip, which is leg_length * 1.75 m above the sole
    add_lathe(
        mesh, Affine3d::Identity(),
        {{0.05, 0.0}, {0.088, -0.06}, {0.08, -0.25}, {0.06, -0.45}, {0.058, -0.55}, {0.042, -0.80}},
        8, cloth);
    add_lathe(mesh, shift(0.06, 0, 0) * Eigen::Scaling(1.0, 0.4, 1.0),
              {{0.13, -0.873}, {0.13, -0.83}, {0.07, -0.77}}, 8, rubber * 2);
    return mesh;
}

Mesh arm() {
    Mesh mesh;
    add_lathe(mesh, Affine3d::Identity(),
              {{0.03, 0.04}, {0.055, 0.0}, {0.045, -0.25}, {0.035, -0.50}}, 8, cloth);
    add_lathe(mesh, Affine3d::Identity(), {{0.035, -0.50}, {0.042, -0.58}, {0.02, -0.67}}, 8, skin);
    return mesh;
}

Mesh limb(double length, double radius) {
    Mesh mesh;
    add_capsule(mesh, {0, 0, -length}, {0, 0, 0}, radius, cloth);
    return mesh;
}

void add_tyre(Mesh& mesh, double x, double radius) {
    constexpr int pieces = 16;
    for (int i = 0; i < pieces; ++i) {
        const SinCos a = portable_sincos(2.0 * std::numbers::pi * i / pieces);
        const SinCos b = portable_sincos(2.0 * std::numbers::pi * (i + 1) / pieces);
        add_capsule(mesh, {x + radius * a.cos, 0, 0.34 + radius * a.sin},
                    {x + radius * b.cos, 0, 0.34 + radius * b.sin}, 0.02, rubber);
        if (i % 4 == 0) {
            add_capsule(mesh, {x, 0, 0.34}, {x + radius * a.cos, 0, 0.34 + radius * a.sin}, 0.006,
                        metal);
        }
    }
}

/// A bicycle with the rider down to the hips.
Mesh bicycle() {
    Mesh mesh;
    add_tyre(mesh, -0.5, 0.32);
    add_tyre(mesh, 0.55, 0.32);
    const Vector3d seat(-0.17, 0, 0.9), pedals(-0.05, 0, 0.3), head(0.38, 0, 0.85);
    for (const auto& [a, b] :
         {std::pair(seat, pedals), std::pair(pedals, head), std::pair(seat, head),
          std::pair(Vector3d(-0.5, 0, 0.34), seat), std::pair(Vector3d(-0.5, 0, 0.34), pedals),
          std::pair(Vector3d(0.55, 0, 0.34), head),
          std::pair(Vector3d(0.38, -0.27, 1.0), Vector3d(0.38, 0.27, 1.0)),
          std::pair(head, Vector3d(0.38, 0, 1.0))}) {
        add_capsule(mesh, a, b, 0.018, metal);
    }
    Affine3d lean = shift(-0.15, 0, 0.95) * Eigen::AngleAxisd(0.45, Vector3d::UnitY());
    append(mesh, torso(false), lean * shift(0, 0, -0.88));
    for (const double side : {-1.0, 1.0}) {
        add_capsule(mesh, {0.10, side * 0.2, 1.42}, {0.38, side * 0.24, 1.02}, 0.045, cloth);
    }
    return mesh;
}

void add_wheels(Mesh& mesh, double front, double rear, double half_width, double radius) {
    for (const double x : {front, rear}) {
        for (const double side : {-1.0, 1.0}) {
            Affine3d T = shift(x, side * (half_width - 0.1), radius);
            T.rotate(Eigen::AngleAxisd(std::numbers::pi / 2.0, Vector3d::UnitX()));
            add_lathe(
                mesh, T,
                {{0.8 * radius, -0.11}, {radius, -0.09}, {radius, 0.09}, {0.8 * radius, 0.11}}, 14,
                rubber);
        }
    }
}

Mesh suitcase() {
    Mesh mesh;
    add_box(mesh, Affine3d::Identity(), {Vector3d(-0.14, -0.22, 0.06), Vector3d(0.14, 0.22, 0.7)},
            cloth);
    for (const double y : {-0.08, 0.08})
        add_capsule(mesh, {-0.1, y, 0.65}, {-0.1, y, 1.0}, 0.01, metal);
    add_capsule(mesh, {-0.1, -0.08, 1.0}, {-0.1, 0.08, 1.0}, 0.015, metal);
    for (const double y : {-0.18, 0.18})
        add_box(mesh, shift(0, y, 0), {Vector3d(-0.12, -0.02, 0), Vector3d(0.12, 0.02, 0.06)},
                2 * rubber);
    return mesh;
}

}  // namespace

Mesh car_mesh() {
    Mesh mesh;
    add_prism(mesh, Affine3d::Identity(),
              {{-2.15, 0.35},
               {-1.9, 0.22},
               {1.9, 0.22},
               {2.15, 0.4},
               {2.1, 0.7},
               {0.95, 0.92},
               {-2.1, 0.95}},
              0.88, paint);
    add_prism(mesh, Affine3d::Identity(),
              {{-1.95, 0.9}, {1.05, 0.88}, {0.25, 1.42}, {-1.2, 1.48}, {-1.7, 1.35}}, 0.75,
              paint * 0.5F);
    add_wheels(mesh, 1.35, -1.35, 0.88, 0.32);
    for (const double side : {-1.0, 1.0}) {  // mirrors
        add_box(mesh, shift(0.75, side * 0.95, 1.0),
                {Vector3d(-0.06, -0.09, -0.06), Vector3d(0.06, 0.09, 0.07)}, paint);
    }
    return mesh;
}

Mesh van_mesh() {
    Mesh mesh;
    add_prism(mesh, Affine3d::Identity(),
              {{-2.7, 0.3},
               {2.6, 0.3},
               {2.7, 0.6},
               {2.6, 1.05},
               {1.9, 1.25},
               {1.3, 2.2},
               {1.0, 2.4},
               {-2.65, 2.4}},
              0.98, paint);
    add_wheels(mesh, 1.7, -1.7, 0.98, 0.36);
    return mesh;
}

Mesh bus_mesh() {
    Mesh mesh;
    add_prism(mesh, Affine3d::Identity(),
              {{-6.0, 0.35},
               {5.9, 0.35},
               {6.0, 0.8},
               {5.85, 2.8},
               {5.5, 3.05},
               {-5.9, 3.05},
               {-6.0, 2.8}},
              1.25, paint);
    add_box(mesh, shift(-1.0, 0, 3.05), {Vector3d(-1.5, -0.8, 0), Vector3d(1.5, 0.8, 0.25)}, paint);
    add_wheels(mesh, 3.3, -2.8, 1.25, 0.48);
    return mesh;
}

Mesh gate_mesh() {
    Mesh mesh;
    const double x = 0.5 * gate_size.x(), y = 0.5 * gate_size.y();
    const auto box = [&](const Vector3d& low, const Vector3d& high) {
        add_box(mesh, Affine3d::Identity(), {low, high}, metal);
    };
    box({-x, -y, 0.1}, {x, y, 0.9});
    box({-x, -y, 1.8}, {x, y, 1.95});
    for (int i = 0; i <= 10; ++i) {
        const double bar = -x + 0.04 + i * (2.0 * x - 0.08) / 10.0;
        box({bar - 0.04, -0.04, 0.9}, {bar + 0.04, 0.04, 1.8});
    }
    return mesh;
}

Mesh load_mesh() {
    Mesh mesh;
    const double x = 0.5 * load_size.x(), y = 0.5 * load_size.y();
    add_box(mesh, Affine3d::Identity(), {Vector3d(-x, -y, 0.3), Vector3d(x, y, 1.6)}, paint);
    for (const double side : {-1.0, 1.0})
        add_capsule(mesh, {side * x, 0.0, 1.6}, {0.0, 0.0, 6.0}, 0.02, metal);
    return mesh;
}

std::vector<Mesh> prototypes() {
    return {torso(false),
            torso(true),
            leg(),
            arm(),
            bicycle(),
            limb(thigh_length, 0.075),
            limb(shin_length, 0.05),
            car_mesh(),
            van_mesh(),
            bus_mesh(),
            suitcase(),
            wagon_mesh(),
            doors_mesh(1.0),
            doors_mesh(-1.0),
            gate_mesh(),
            load_mesh()};
}

}  // namespace dynamic_filter::sim
