// SPDX-License-Identifier: MIT
#include "paper/normals.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>
#include <map>
#include <numbers>

#include "dynamic_filter/parallel.hpp"
#include "paper/submap.hpp"
#include "support/random.hpp"
#include "support/reference_axes.hpp"

namespace dynamic_filter {
namespace normals_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Compares with the definition, point by point; returns how many normals were compared.
int expect_as_defined(const Points& points, float voxel_size) {
    std::map<VoxelKey, Points> voxels;
    for (const Point& p : points) voxels[*voxel_of(p, voxel_size)].push_back(p);
    std::map<VoxelKey, std::optional<Point>> known;  // of unclear voxels: nothing
    for (const auto& [key, own] : voxels) {
        Points around;
        for (int dx = -1; dx <= 1; ++dx) {
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dz = -1; dz <= 1; ++dz) {
                    const auto it = voxels.find(pack(unpack(key) + Cell(dx, dy, dz)));
                    if (it == voxels.end()) continue;
                    around.insert(around.end(), it->second.begin(), it->second.end());
                }
            }
        }
        if (around.size() < 3) {
            known[key] = Point::Zero();
            continue;
        }
        const auto solver = test::reference_axes(around);
        const Eigen::Vector3d v = solver.eigenvalues();
        if (v[1] > 1e-4 * v[2] && v[1] > 1.2 * v[0]) {
            known[key] = solver.eigenvectors().col(0).cast<float>();
        }
    }
    const Points normals = estimate_normals(points, voxel_size);
    EXPECT_EQ(normals.size(), points.size());
    int compared = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& expected = known[*voxel_of(points[i], voxel_size)];
        if (!expected) continue;
        const bool equal = expected->isZero() ? normals[i].isZero()
                                              : std::abs(normals[i].dot(*expected)) > 0.9999F;
        EXPECT_TRUE(equal) << i << ": " << normals[i].transpose() << " | " << expected->transpose();
        if (!equal) return -1;
        ++compared;
    }
    return compared;
}

/// Pieces of planes in all directions, on both sides of every axis.
Points planes(test::Random& random, std::size_t pieces, int per_piece, double half_width) {
    Points points;
    for (std::size_t k = 0; k < pieces; ++k) {
        const Point normal = random.direction().cast<float>(), at = random.point(half_width);
        for (int i = 0; i < per_piece; ++i) {
            const Point p = random.point(0.8);
            points.push_back(at + p - normal * (normal.dot(p) - random.uniform_f(-0.02, 0.02)));
        }
    }
    return points;
}

TEST(EstimateNormals, AreTheSmallestAxesOfThe27VoxelsAround) {
    test::Random random(1);
    for (const float voxel_size : {0.2F, 0.5F}) {
        EXPECT_GT(expect_as_defined(planes(random, 30, 60, 3.0), voxel_size), 1000);
    }
}

TEST(EstimateNormals, AreTheSameInManyChunksAndOnAnyNumberOfThreads) {
    test::Random random(2);
    const Points points = planes(random, 300, 100, 12.0);  // well over 4096 voxels
    EXPECT_GT(expect_as_defined(points, 0.2F), 10000);
    Points one, two;
    with_threads(1, [&] { one = estimate_normals(points, 0.2F); });
    with_threads(2, [&] { two = estimate_normals(points, 0.2F); });
    EXPECT_EQ(one, two);
}

TEST(EstimateNormals, FindTheGroundAndAWall) {
    Points points;
    for (int a = -20; a < 20; ++a) {
        for (int b = -20; b < 20; ++b) {
            const float u = 0.1F * static_cast<float>(a) + 0.03F,
                        v = 0.1F * static_cast<float>(b) + 0.03F;
            points.emplace_back(u, v, -1.5F);
            points.emplace_back(u, 8.0F, v);
        }
    }
    const Points normals = estimate_normals(points, 0.2F);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR(std::abs(normals[i][i % 2 == 0 ? 2 : 1]), 1.0F, 1e-4F);
    }
}

TEST(EstimateNormals, AreZeroWherePointsSpanNoPlane) {
    EXPECT_TRUE(estimate_normals({}, 0.2F).empty());
    const auto all_zero = [](const Points& points) {
        for (const Point& n : estimate_normals(points, 0.2F)) {
            if (!n.isZero()) return false;
        }
        return true;
    };
    EXPECT_TRUE(all_zero({{1, 2, 3}}));
    EXPECT_TRUE(all_zero({{1, 2, 3}, {1.1F, 2, 3}}));
    EXPECT_TRUE(all_zero({{0.1F, 0, 0}, {0.2F, 0, 0}, {0.3F, 0, 0}, {0.4F, 0, 0}}));
    EXPECT_TRUE(all_zero({{0, 0, 0}, {5, 0, 0}, {0, 5, 0}}));  // far apart
}

TEST(EstimateNormals, PointsThatNoKeyReachesHaveNone) {
    const Points points{
        {kNan, 0, 0}, {0, 0, 0.01F}, {0.1F, 0, 0.01F}, {0, 0.1F, 0.01F}, {1e9F, 0, 0}};
    const Points normals = estimate_normals(points, 0.2F);
    EXPECT_TRUE(normals.front().isZero());
    EXPECT_TRUE(normals.back().isZero());
    for (std::size_t i = 1; i < 4; ++i) EXPECT_NEAR(std::abs(normals[i].z()), 1.0F, 1e-5F);
}

TEST(EstimateNormals, WorkAtTheLimitsOfTheKeys) {
    for (const float edge : {-1.04857e5F, 1.0485e5F}) {
        const Points points{
            {edge, edge, edge}, {edge + 0.125F, edge, edge}, {edge, edge + 0.125F, edge}};
        for (const Point& n : estimate_normals(points, 0.2F)) EXPECT_LE(n.norm(), 1.001F);
    }
}

TEST(IsGrazing, ComparesTheAngleFromHeadOnWithTheThreshold) {
    test::Random random(3);
    for (int i = 0; i < 2000; ++i) {
        const double threshold = random.uniform(5.0, 85.0), angle = random.uniform(0.0, 180.0);
        if (std::abs(std::min(angle, 180.0 - angle) - threshold) < 0.01) continue;
        constexpr double kDeg = std::numbers::pi / 180.0;
        const Eigen::Vector3d normal = random.direction();
        const Eigen::Vector3d beam =
            Eigen::AngleAxisd(angle * kDeg, normal.unitOrthogonal()) * normal;
        const Point viewpoint = random.point(5.0);
        const Point point = viewpoint + random.uniform_f(1.0, 30.0) * beam.cast<float>();
        EXPECT_EQ(is_grazing(point, normal.cast<float>(), viewpoint,
                             static_cast<float>(std::cos(threshold * kDeg))),
                  std::min(angle, 180.0 - angle) > threshold);
    }
}

TEST(IsGrazing, WithoutANormalAPointIsOrdinary) {
    EXPECT_FALSE(is_grazing({1, 0, 0}, Point::Zero(), {0, 0, 0}, 0.5F));
}

}  // namespace normals_test
}  // namespace dynamic_filter
