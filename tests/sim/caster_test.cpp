// SPDX-License-Identifier: MIT
#include "sim/caster.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "sim/prototypes.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim::caster_test {

using Eigen::Vector3d;

namespace {

/// Moeller & Trumbore, J. Graphics Tools 1997.
std::optional<double> crossing(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                               const Vector3d& origin, const Vector3d& direction) {
    const Vector3d u = b - a, v = c - a, p = direction.cross(v);
    const double det = u.dot(p);
    if (std::abs(det) < 1e-14) return {};
    const Vector3d s = origin - a, q = s.cross(u);
    const double x = s.dot(p) / det, y = direction.dot(q) / det, t = v.dot(q) / det;
    if (x < 0.0 || y < 0.0 || x + y > 1.0 || t < 0.0) return {};
    return t;
}

double brute_force(const Mesh& mesh, const Vector3d& origin, const Vector3d& direction) {
    double nearest = 1e9;
    for (const auto& t : mesh.triangles) {
        const auto corner = [&](int k) -> Vector3d {
            return mesh.vertices[static_cast<std::size_t>(t[k])].cast<double>();
        };
        const auto hit = crossing(corner(0), corner(1), corner(2), origin, direction);
        if (hit) nearest = std::min(nearest, *hit);
    }
    return nearest;
}

Vector3d draw_direction(Random& random) {
    return Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))
        .normalized();
}

/// Rays that graze an edge may go either way; the others must agree.
template <typename Truth>
void expect_agreement(const Caster& caster, const Vector3d& origin, const Truth& truth) {
    Random random{9};
    int hits = 0, differences = 0;
    for (int i = 0; i < 4000; ++i) {
        const Vector3d d = draw_direction(random);
        const double expected = truth(d);
        const Hit hit = caster.cast(origin.cast<float>(), d.cast<float>(), 100.0F);
        hits += hit.found;
        const double range = hit.found ? static_cast<double>(hit.range) : 1e9;
        differences += std::abs(range - expected) > 1e-4;
    }
    EXPECT_GT(hits, 100);
    EXPECT_LE(differences, 2);
}

}  // namespace

TEST(Caster, AgreesWithBruteForceOnStillMesh) {
    const Mesh mesh = car_mesh();
    const Caster caster(mesh, {}, {});
    const Vector3d origin(0.5, -3.0, 1.2);
    expect_agreement(caster, origin,
                     [&](const Vector3d& d) { return brute_force(mesh, origin, d); });
}

TEST(Caster, AgreesWithBruteForceOnMovedPart) {
    const Mesh car = car_mesh();
    Mesh far;
    add_quad(far, {500, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.5F);
    Caster caster(far, {car}, {{.prototype = 0}});
    Eigen::Affine3d T = Eigen::Affine3d::Identity();
    T.translate(Vector3d(3, 1, 0)).rotate(Eigen::AngleAxisd(0.7, Vector3d::UnitZ())).scale(1.1);
    caster.place({{T.cast<float>(), Kind::vehicle}});
    Mesh moved;
    append(moved, car, T);
    const Vector3d origin(0.2, -0.5, 1.2);
    expect_agreement(caster, origin,
                     [&](const Vector3d& d) { return brute_force(moved, origin, d); });
}

TEST(Caster, OtherPartsTakeThePlaceOfAll) {
    Mesh wall;
    add_quad(wall, {0, -1, -1}, {0, 2, 0}, {0, 0, 2}, {0.5F, Kind::thin});
    Caster caster({}, {wall}, {{.prototype = 0}, {.prototype = 0}});
    Eigen::Affine3f near = Eigen::Affine3f::Identity(), far = near;
    near.translation().x() = 2.0F;
    far.translation().x() = 4.0F;
    caster.place({{near, Kind::vehicle}, {far, Kind::vehicle}});
    const auto ahead = [&] { return caster.cast({0, 0, 0}, {1, 0, 0}, 50.0F); };
    EXPECT_FLOAT_EQ(ahead().range, 2.0F);
    EXPECT_EQ(ahead().kind, Kind::vehicle);
    caster.replace({{.prototype = 0, .is_still = true}});
    caster.place({{far, Kind::vehicle}});
    EXPECT_FLOAT_EQ(ahead().range, 4.0F);
    EXPECT_EQ(ahead().kind, Kind::thin);
    caster.replace({});
    caster.place({});
    EXPECT_FALSE(ahead().found);
}

TEST(Caster, TellsSurfaceFromRay) {
    Mesh floor, wall;
    add_quad(floor, {-10, -10, 0}, {20, 0, 0}, {0, 20, 0}, {0.25F, Kind::ground});
    add_quad(wall, {0, -1, -1}, {0, 2, 0}, {0, 0, 2}, 0.5F);
    Caster caster(floor, {wall}, {{.prototype = 0, .brightness = 0.5F}});
    Eigen::Affine3f T = Eigen::Affine3f::Identity();
    T.translation().x() = 4.0F;
    caster.place({{T, Kind::standing}});
    const Hit down = caster.cast({0, 0, 2}, Eigen::Vector3f(0.6F, 0, -0.8F), 50.0F);
    ASSERT_TRUE(down.found);
    EXPECT_NEAR(down.range, 2.5F, 1e-5F);
    EXPECT_NEAR(down.cosine, 0.8F, 1e-5F);
    EXPECT_EQ(down.reflectivity, 0.25F);
    EXPECT_EQ(down.kind, Kind::ground);
    const Hit ahead = caster.cast({0, 0, 0.5F}, Eigen::Vector3f::UnitX(), 50.0F);
    ASSERT_TRUE(ahead.found);
    EXPECT_NEAR(ahead.range, 4.0F, 1e-5F);
    EXPECT_EQ(ahead.reflectivity, 0.25F);
    EXPECT_EQ(ahead.kind, Kind::standing);
    EXPECT_FALSE(caster.cast({0, 0, 0.5F}, Eigen::Vector3f::UnitX(), 3.0F).found);
}

}  // namespace dynamic_filter::sim::caster_test
