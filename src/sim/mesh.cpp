// SPDX-License-Identifier: MIT
#include "sim/mesh.hpp"

#include <cmath>
#include <numbers>

#include "sim/portable.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {
namespace {

using Eigen::Vector3d;

int add_vertex(Mesh& mesh, const Vector3d& p) {
    mesh.vertices.emplace_back(p.cast<float>());
    return static_cast<int>(mesh.vertices.size()) - 1;
}

void add_triangle(Mesh& mesh, int a, int b, int c, Material material) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.materials.push_back(material);
}

Vector3d random_direction(Random& random) {
    const double z = random.uniform(-1.0, 1.0);
    const SinCos a = portable_sincos(random.uniform(0.0, 2.0 * std::numbers::pi));
    const double r = std::sqrt(1.0 - z * z);
    return {r * a.cos, r * a.sin, z};
}

}  // namespace

void append(Mesh& mesh, const Mesh& other, const Eigen::Affine3d& T) {
    const auto offset = static_cast<int>(mesh.vertices.size());
    for (const auto& v : other.vertices) add_vertex(mesh, T * v.cast<double>());
    for (const auto& t : other.triangles) mesh.triangles.emplace_back(t.array() + offset);
    mesh.materials.insert(mesh.materials.end(), other.materials.begin(), other.materials.end());
}

void add_quad(Mesh& mesh, const Vector3d& corner, const Vector3d& u, const Vector3d& v,
              Material material) {
    const int a = add_vertex(mesh, corner);
    const int b = add_vertex(mesh, corner + u);
    const int c = add_vertex(mesh, corner + u + v);
    const int d = add_vertex(mesh, corner + v);
    add_triangle(mesh, a, b, c, material);
    add_triangle(mesh, a, c, d, material);
}

void pave(Mesh& mesh, std::size_t first) {
    constexpr float level = 0.9F;  // includes ramps
    const auto vertex = [&](int i) { return mesh.vertices[static_cast<std::size_t>(i)]; };
    for (std::size_t i = first; i < mesh.triangles.size(); ++i) {
        const auto& t = mesh.triangles[i];
        const Eigen::Vector3f a = vertex(t[0]);
        const Eigen::Vector3f normal = (vertex(t[1]) - a).cross(vertex(t[2]) - a).normalized();
        if (std::abs(normal.z()) > level) mesh.materials[i].kind = Kind::ground;
    }
}

void add_box(Mesh& mesh, const Eigen::Affine3d& T, const Eigen::AlignedBox3d& box,
             Material material) {
    const auto& low = box.min();
    const Vector3d size = box.sizes();
    for (int axis = 0; axis < 3; ++axis) {
        const Vector3d u = size[(axis + 1) % 3] * Vector3d::Unit((axis + 1) % 3);
        const Vector3d v = size[(axis + 2) % 3] * Vector3d::Unit((axis + 2) % 3);
        for (const double side : {0.0, size[axis]}) {
            const Vector3d corner = low + side * Vector3d::Unit(axis);
            add_quad(mesh, T * corner, T.linear() * u, T.linear() * v, material);
        }
    }
}

void add_lathe(Mesh& mesh, const Eigen::Affine3d& T, const std::vector<Outline>& outline, int sides,
               Material material) {
    const auto rings = static_cast<int>(outline.size());
    const int first = static_cast<int>(mesh.vertices.size());
    for (const auto& [radius, z] : outline) {
        for (int i = 0; i < sides; ++i) {
            const SinCos a = portable_sincos(2.0 * std::numbers::pi * i / sides);
            add_vertex(mesh, T * Vector3d(radius * a.cos, radius * a.sin, z));
        }
    }
    for (int ring = 0; ring + 1 < rings; ++ring) {
        for (int i = 0; i < sides; ++i) {
            const int a = first + ring * sides + i;
            const int b = first + ring * sides + (i + 1) % sides;
            add_triangle(mesh, a, b, b + sides, material);
            add_triangle(mesh, a, b + sides, a + sides, material);
        }
    }
    for (const int ring : {0, rings - 1}) {
        const int centre =
            add_vertex(mesh, T * Vector3d(0.0, 0.0, outline[ring == 0 ? 0 : outline.size() - 1].z));
        for (int i = 0; i < sides; ++i) {
            add_triangle(mesh, centre, first + ring * sides + i,
                         first + ring * sides + (i + 1) % sides, material);
        }
    }
}

void add_capsule(Mesh& mesh, const Vector3d& a, const Vector3d& b, double radius,
                 Material material) {
    const double length = (b - a).norm();
    Eigen::Affine3d T = Eigen::Affine3d::Identity();
    T.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), b - a).toRotationMatrix();
    T.translation() = a;
    const double s = 0.7 * radius;
    add_lathe(mesh, T,
              {{0.3 * radius, -radius},
               {s, -s},
               {radius, 0.0},
               {radius, length},
               {s, length + s},
               {0.3 * radius, length + radius}},
              8, material);
}

void add_prism(Mesh& mesh, const Eigen::Affine3d& T, const std::vector<Eigen::Vector2d>& polygon,
               double half_width, Material material) {
    const auto n = static_cast<int>(polygon.size());
    const int first = static_cast<int>(mesh.vertices.size());
    for (const double y : {-half_width, half_width}) {
        for (const auto& p : polygon) add_vertex(mesh, T * Vector3d(p.x(), y, p.y()));
    }
    for (int i = 0; i < n; ++i) {
        const int a = first + i;
        const int b = first + (i + 1) % n;
        add_triangle(mesh, a, b, b + n, material);
        add_triangle(mesh, a, b + n, a + n, material);
    }
    for (int i = 1; i + 1 < n; ++i) {
        add_triangle(mesh, first, first + i, first + i + 1, material);
        add_triangle(mesh, first + n, first + n + i, first + n + i + 1, material);
    }
}

void add_leaves(Mesh& mesh, const Crown& crown, Material material) {
    Random random{hash(crown.seed, 0x1eaf)};
    for (int i = 0; i < crown.leaves; ++i) {
        const double depth = std::sqrt(random.uniform(0.15, 1.0));
        const Vector3d offset = depth * random_direction(random);
        const Vector3d centre = crown.centre + crown.radii.cwiseProduct(offset);
        const Vector3d u = crown.leaf_size * random_direction(random);
        const Vector3d v = crown.leaf_size * random_direction(random);
        const int a = add_vertex(mesh, centre);
        const int b = add_vertex(mesh, centre + u);
        const int c = add_vertex(mesh, centre + v);
        add_triangle(mesh, a, b, c, material);
    }
}

}  // namespace dynamic_filter::sim
