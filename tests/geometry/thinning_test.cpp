// SPDX-License-Identifier: MIT
#include "geometry/thinning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

#include "support/random.hpp"

namespace dynamic_filter {
namespace thinning_test {

/// A street of 159 m x 23 m between walls, seen by `beams` beams of 1,800 directions with 2 cm of
/// noise.
Points scan(int beams, double lowest, double highest) {
    test::Random random(3);
    Points points;
    for (int beam = 0; beam < beams; ++beam) {
        const double degrees = lowest + (highest - lowest) * beam / (beams - 1);
        const double elevation = degrees * std::numbers::pi / 180.0;
        for (int i = 0; i < 1800; ++i) {
            const double azimuth = 2.0 * std::numbers::pi * i / 1800.0;
            const Eigen::Vector3d direction(std::cos(azimuth) * std::cos(elevation),
                                            std::sin(azimuth) * std::cos(elevation),
                                            std::sin(elevation));
            const double wall =
                std::min(79.3 / std::abs(direction.x()), 11.6 / std::abs(direction.y()));
            const double ground = direction.z() < 0.0 ? 1.64 / -direction.z() : 1e9;
            const double range = std::min(wall, ground) + random.uniform(-0.02, 0.02);
            points.push_back((direction * range).cast<float>());
        }
    }
    return points;
}

/// The centroid of each voxel.
Points filtered(const Points& points, float side) {
    std::map<std::tuple<int, int, int>, std::pair<Point, int>> voxels;
    for (const Point& p : points) {
        const Eigen::Vector3i cell = (p / side).array().floor().cast<int>();
        auto& [sum, count] =
            voxels.try_emplace({cell.x(), cell.y(), cell.z()}, Point::Zero(), 0).first->second;
        sum += p;
        ++count;
    }
    Points kept;
    for (const auto& [cell, voxel] : voxels) {
        kept.push_back(voxel.first / static_cast<float>(voxel.second));
    }
    return kept;
}

TEST(Thinning, OfAVoxelFilterIsMeasured) {
    for (const Points& points : {scan(16, -15.0, 15.0), scan(64, -25.0, 3.0)}) {
        for (const float side : {0.25F, 0.5F, 1.0F}) {
            EXPECT_GT(thinning_of(filtered(points, side)), 0.6F * side);
            EXPECT_LT(thinning_of(filtered(points, side)), 1.7F * side);
        }
    }
}

TEST(Thinning, IsNoneInScansAsMeasuredOrWithFewerBeams) {
    for (const int beams : {8, 16, 32, 64, 128}) {
        const Points points = scan(beams, -20.0, 12.0);
        EXPECT_EQ(thinning_of(points), 0.0F) << beams;
        Points some;
        for (std::size_t i = 0; i < points.size(); i += 5) some.push_back(points[i]);
        EXPECT_EQ(thinning_of(some), 0.0F) << beams;
    }
}

TEST(Thinning, IsNotJudgedOfPointsThatAreNoMetres) {
    Points points = filtered(scan(16, -15.0, 15.0), 0.5F);
    for (Point& p : points) p *= 1000.0F;
    EXPECT_EQ(thinning_of(points), 0.0F);
}

TEST(Thinning, IsNotJudgedByFewPointsOrPointsWithoutMeasurement) {
    Points points(1000, Point::Constant(std::numeric_limits<float>::quiet_NaN()));
    EXPECT_EQ(thinning_of(points), 0.0F);
    EXPECT_EQ(thinning_of({}), 0.0F);
    points.assign(1000, Point::Zero());
    EXPECT_EQ(thinning_of(points), 0.0F);
    points.assign(1000, Point(5.0F, 1.0F, 0.0F));  // the same point a thousand times
    EXPECT_EQ(thinning_of(points), 0.0F);
}

}  // namespace thinning_test
}  // namespace dynamic_filter
