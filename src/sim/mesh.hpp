// SPDX-License-Identifier: MIT
/// Triangle meshes, and the simple shapes of which bodies and buildings are made.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "dynamic_filter/simulation.hpp"

namespace dynamic_filter::sim {

/// What a smooth surface does with the light that it does not scatter: shares 0..1 at normal
/// incidence. Towards grazing incidence, it reflects more and more (Schlick 1994).
struct Gloss {
    float reflects = 0.0F;  ///< as a mirror
    float transmits = 0.0F;
};

/// Material of a surface. A reflectivity (0..1) alone means a structure. The kind of moving parts
/// comes from their placement instead.
struct Material {
    constexpr Material(float r, Kind k = Kind::structure, Gloss g = {})
        : reflectivity(r), kind(k), gloss(g) {}
    float reflectivity;
    Kind kind;
    Gloss gloss;
};

struct Mesh {
    std::vector<Eigen::Vector3f> vertices;
    std::vector<Eigen::Vector3i> triangles;
    std::vector<Material> materials;  ///< one per triangle
};

/// Radius at a height: a point of the outline of a body of revolution.
struct Outline {
    double radius = 0.0;
    double z = 0.0;
};

inline Eigen::Affine3d shift(double x, double y, double z) {
    return Eigen::Affine3d(Eigen::Translation3d(x, y, z));
}

void append(Mesh& mesh, const Mesh& other, const Eigen::Affine3d& T);

/// A rectangle spanned by `u` and `v` from `corner`.
void add_quad(Mesh& mesh, const Eigen::Vector3d& corner, const Eigen::Vector3d& u,
              const Eigen::Vector3d& v, Material material);

/// Marks the horizontal surfaces from triangle `first` on as ground, because people walk on them.
void pave(Mesh& mesh, std::size_t first);

/// An axis-aligned box in the frame `T`.
void add_box(Mesh& mesh, const Eigen::Affine3d& T, const Eigen::AlignedBox3d& box,
             Material material);

/// A body of revolution around z in the frame `T`, with closed ends. A scale in `T` makes it
/// elliptic.
void add_lathe(Mesh& mesh, const Eigen::Affine3d& T, const std::vector<Outline>& outline, int sides,
               Material material);

/// A round bar from `a` to `b` with hemispherical ends.
void add_capsule(Mesh& mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius,
                 Material material);

/// A convex polygon in the x-z plane (counter-clockwise seen from -y), extruded over
/// y in [-half_width, half_width].
void add_prism(Mesh& mesh, const Eigen::Affine3d& T, const std::vector<Eigen::Vector2d>& polygon,
               double half_width, Material material);

struct Crown {
    Eigen::Vector3d centre;
    Eigen::Vector3d radii;
    int leaves = 0;
    double leaf_size = 0.1;  ///< [m] edge length
    std::uint64_t seed = 0;
};

/// Loose triangles in an ellipsoid, denser near its surface, so that some rays pass through.
void add_leaves(Mesh& mesh, const Crown& crown, Material material);

}  // namespace dynamic_filter::sim
