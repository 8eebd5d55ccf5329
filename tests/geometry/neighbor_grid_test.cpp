// SPDX-License-Identifier: MIT
#include "geometry/neighbor_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/random.hpp"

namespace dynamic_filter {
namespace neighbor_grid_test {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::vector<Neighbor> brute_force(const Points& points, float radius, const Point& query,
                                  std::size_t k) {
    std::vector<Neighbor> found;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const float d = (points[i] - query).squaredNorm();
        if (d <= radius * radius) found.push_back({d, i});
    }
    std::stable_sort(found.begin(), found.end(), [](const Neighbor& a, const Neighbor& b) {
        return a.distance_sq < b.distance_sq;
    });
    if (found.size() > k) found.resize(k);
    return found;
}

void expect_nearest(const Points& points, float radius, const Points& queries) {
    const NeighborGrid grid(points, radius);
    std::vector<Neighbor> out(3);  // left-overs must go
    for (const Point& query : queries) {
        for (const std::size_t k : {1, 2, 5, 1000}) {
            grid.nearest(query, k, out);
            const auto expected = brute_force(points, radius, query, k);
            ASSERT_EQ(out.size(), expected.size());
            for (std::size_t i = 0; i < out.size(); ++i) {
                ASSERT_EQ(out[i].index, expected[i].index) << "k " << k << " place " << i;
                ASSERT_EQ(out[i].distance_sq, expected[i].distance_sq);
                ASSERT_EQ(grid.point(out[i].index), points[out[i].index]);
            }
        }
    }
}

void expect_any_within(const Points& points, float radius, const Points& queries) {
    const NeighborGrid grid(points, radius);
    for (const Point& query : queries) {
        for (const float share : {0.5F, 0.3F, 0.1F}) {
            const float distance = share * radius;
            const bool expected = std::any_of(points.begin(), points.end(), [&](const Point& p) {
                return (p - query).squaredNorm() <= distance * distance;
            });
            ASSERT_EQ(grid.any_within(query, distance), expected);
        }
    }
}

/// Points of a lattice that falls on cell borders, some twice: many equal distances.
Points lattice(float step) {
    Points points;
    for (int x = -3; x <= 3; ++x) {
        for (int y = -3; y <= 3; ++y) {
            for (int z = -3; z <= 3; ++z) {
                points.push_back(Point(Cell(x, y, z).cast<float>()) * step);
                if ((x + y + z) % 3 == 0) points.push_back(points.back());
            }
        }
    }
    return points;
}

TEST(NeighborGrid, NearestAgreesWithBruteForce) {
    test::Random random(1);
    for (const float radius : {0.3F, 0.5F, 1.0F}) {
        for (const std::size_t count : {1, 20, 300, 2000}) {
            expect_nearest(random.points(count, 2.0), radius, random.points(100, 2.5));
        }
    }
}

TEST(NeighborGrid, AnyWithinAgreesWithBruteForce) {
    test::Random random(2);
    for (const float radius : {0.3F, 1.0F}) {
        for (const std::size_t count : {1, 50, 500, 3000}) {
            expect_any_within(random.points(count, 2.0), radius, random.points(300, 2.5));
        }
    }
}

TEST(NeighborGrid, EqualDistancesGoByIndexAlsoOnCellBorders) {
    expect_nearest(lattice(0.5F), 0.5F, lattice(0.25F));
    expect_nearest(lattice(0.25F), 0.5F, lattice(0.25F));
    expect_any_within(lattice(0.5F), 0.5F, lattice(0.25F));
    expect_any_within(lattice(0.5F), 1.0F, lattice(0.25F));
}

TEST(NeighborGrid, ClustersFarFromTheOriginAreFoundToo) {
    test::Random random(3);
    Points points = random.points(500, 1.0), queries = random.points(50, 1.2);
    for (Point& p : points) p += Point(-500.0F, 700.0F, -30.0F);
    for (Point& q : queries) q += Point(-500.0F, 700.0F, -30.0F);
    expect_nearest(points, 0.5F, queries);
    expect_any_within(points, 0.5F, queries);
}

TEST(NeighborGrid, TheRadiusIsInclusive) {
    const NeighborGrid grid(Points{{1, 0, 0}}, 1.0F);
    std::vector<Neighbor> out;
    grid.nearest({0, 0, 0}, 1, out);
    EXPECT_EQ(out.size(), 1U);
    grid.nearest({-1e-6F, 0, 0}, 1, out);
    EXPECT_TRUE(out.empty());
    EXPECT_TRUE(grid.any_within({0.5F, 0, 0}, 0.5F));
    EXPECT_FALSE(grid.any_within({0.4999F, 0, 0}, 0.5F));
}

TEST(NeighborGrid, AnEmptyGridFindsNothing) {
    const NeighborGrid grid({}, 0.5F);
    std::vector<Neighbor> out(2);
    grid.nearest({0, 0, 0}, 5, out);
    EXPECT_TRUE(out.empty());
    EXPECT_FALSE(grid.any_within({0, 0, 0}, 0.25F));
    EXPECT_EQ(grid.size(), 0U);
}

TEST(NeighborGrid, LeavesOutPointsThatAreNotFinite) {
    const NeighborGrid grid(Points{{kNan, 0, 0}, {0.1F, 0, 0}, {0, kInf, 0}, {0, 0, -kInf}}, 0.5F);
    std::vector<Neighbor> out;
    grid.nearest({0, 0, 0}, 5, out);
    ASSERT_EQ(out.size(), 1U);
    EXPECT_EQ(out[0].index, 1U);
    EXPECT_EQ(grid.size(), 1U);
}

TEST(NeighborGrid, OddQueriesFindNothing) {
    const NeighborGrid grid(Points{{0, 0, 0}}, 0.5F);
    std::vector<Neighbor> out(2);
    for (const Point& query : {Point(kNan, 0, 0), Point(0, kInf, 0), Point(1e30F, 0, 0)}) {
        grid.nearest(query, 5, out);
        EXPECT_TRUE(out.empty());
        EXPECT_FALSE(grid.any_within(query, 0.25F));
    }
    grid.nearest({0, 0, 0}, 0, out);
    EXPECT_TRUE(out.empty());
}

TEST(NeighborGrid, WorksAtTheLimitsOfTheKeys) {
    const auto edge = static_cast<float>(kCellLimit - 1);
    const Points points{{edge, edge, edge}, {-edge, -edge, -edge}};
    expect_nearest(points, 1.0F, points);
}

}  // namespace neighbor_grid_test
}  // namespace dynamic_filter
