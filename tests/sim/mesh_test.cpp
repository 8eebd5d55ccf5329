// SPDX-License-Identifier: MIT
#include "sim/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dynamic_filter::sim::mesh_test {

using Eigen::Affine3d;
using Eigen::Vector3d;

namespace {

double area(const Mesh& mesh) {
    double sum = 0.0;
    for (const auto& t : mesh.triangles) {
        const Eigen::Vector3f u = mesh.vertices[static_cast<std::size_t>(t[1])] -
                                  mesh.vertices[static_cast<std::size_t>(t[0])];
        const Eigen::Vector3f v = mesh.vertices[static_cast<std::size_t>(t[2])] -
                                  mesh.vertices[static_cast<std::size_t>(t[0])];
        sum += 0.5 * static_cast<double>(u.cross(v).norm());
    }
    return sum;
}

}  // namespace

TEST(Mesh, BoxHasItsSurface) {
    Mesh mesh;
    add_box(mesh, Affine3d::Identity(), {Vector3d(0, 0, 0), Vector3d(1, 2, 3)}, 0.5F);
    EXPECT_EQ(mesh.triangles.size(), 12U);
    EXPECT_EQ(mesh.materials.size(), 12U);
    EXPECT_NEAR(area(mesh), 22.0, 1e-5);
}

TEST(Mesh, LatheIsAClosedCylinder) {
    Mesh mesh;
    add_lathe(mesh, Affine3d::Identity(), {{1.0, 0.0}, {1.0, 2.0}}, 64, 0.5F);
    EXPECT_NEAR(area(mesh), 6.0 * std::numbers::pi, 0.05);
}

TEST(Mesh, PrismOfASquare) {
    Mesh mesh;
    add_prism(mesh, Affine3d::Identity(), {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.5, 0.5F);
    EXPECT_NEAR(area(mesh), 6.0, 1e-5);
}

TEST(Mesh, CapsuleStaysWithinItsRadius) {
    Mesh mesh;
    add_capsule(mesh, {1, 0, 0}, {1, 0, -2}, 0.1, 0.5F);
    for (const auto& v : mesh.vertices) {
        EXPECT_LT(std::hypot(v.x() - 1.0F, v.y()), 0.1001F);
        EXPECT_GT(v.z(), -2.11F);
        EXPECT_LT(v.z(), 0.11F);
    }
}

TEST(Mesh, LeavesFillTheirCrownAndRepeat) {
    const Crown crown{.centre = {0, 0, 5}, .radii = {2, 2, 1}, .leaves = 500, .seed = 4};
    Mesh a, b;
    add_leaves(a, crown, 0.4F);
    add_leaves(b, crown, 0.4F);
    ASSERT_EQ(a.triangles.size(), 500U);
    for (std::size_t i = 0; i < a.vertices.size(); ++i) {
        EXPECT_EQ(a.vertices[i], b.vertices[i]);
        EXPECT_LT((a.vertices[i] - Eigen::Vector3f(0, 0, 5)).norm(), 2.2F);
    }
}

TEST(Mesh, AppendMovesAndKeepsIndicesApart) {
    Mesh mesh, quad;
    add_quad(quad, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3F, Kind::thin});
    append(mesh, quad, Affine3d::Identity());
    append(mesh, quad, Affine3d(Eigen::Translation3d(0, 0, 2)));
    ASSERT_EQ(mesh.triangles.size(), 4U);
    EXPECT_EQ(mesh.vertices[static_cast<std::size_t>(mesh.triangles[2][0])].z(), 2.0F);
    ASSERT_EQ(mesh.materials.size(), 4U);
    for (const Material& material : mesh.materials) {
        EXPECT_EQ(material.reflectivity, 0.3F);
        EXPECT_EQ(material.kind, Kind::thin);
    }
}

TEST(Mesh, EveryShapeKeepsItsMaterial) {
    const Material material(0.4F, Kind::vegetation);
    const Affine3d T = Affine3d::Identity();
    Mesh mesh;
    add_quad(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, material);
    add_box(mesh, T, {Vector3d(0, 0, 0), Vector3d(1, 2, 3)}, material);
    add_lathe(mesh, T, {{1.0, 0.0}, {1.0, 2.0}}, 8, material);
    add_capsule(mesh, {1, 0, 0}, {1, 0, -2}, 0.1, material);
    add_prism(mesh, T, {{0, 0}, {1, 0}, {1, 1}}, 0.5, material);
    add_leaves(mesh, {.centre = {0, 0, 5}, .radii = {2, 2, 1}, .leaves = 9}, material);
    ASSERT_EQ(mesh.materials.size(), mesh.triangles.size());
    for (const Material& m : mesh.materials) EXPECT_EQ(m.kind, Kind::vegetation);
}

TEST(Mesh, PavingTakesTheLevelFacesFromATriangleOn) {
    const Affine3d T = Affine3d::Identity();
    Mesh mesh;
    add_box(mesh, T, {Vector3d(0, 0, 0), Vector3d(1, 1, 1)}, 0.5F);
    const std::size_t first = mesh.triangles.size();
    add_box(mesh, T, {Vector3d(2, 0, 0), Vector3d(3, 1, 1)}, 0.5F);
    add_prism(mesh, T, {{4, 0}, {9, 0}, {9, 0.5}}, 0.5, 0.5F);  // a ramp
    pave(mesh, first);
    std::size_t before = 0, after = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        (i < first ? before : after) += mesh.materials[i].kind == Kind::ground;
    }
    EXPECT_EQ(before, 0U);
    EXPECT_EQ(after, 8U);  // top and bottom of the box and of the ramp
}

}  // namespace dynamic_filter::sim::mesh_test
