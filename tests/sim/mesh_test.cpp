// SPDX-License-Identifier: MIT
#include "sim/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace dynamic_filter::sim;
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
    EXPECT_EQ(mesh.reflectivity.size(), 12U);
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
    add_quad(quad, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.3F);
    append(mesh, quad, Affine3d::Identity());
    append(mesh, quad, Affine3d(Eigen::Translation3d(0, 0, 2)));
    ASSERT_EQ(mesh.triangles.size(), 4U);
    EXPECT_EQ(mesh.vertices[static_cast<std::size_t>(mesh.triangles[2][0])].z(), 2.0F);
}
