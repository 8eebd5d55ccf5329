// SPDX-License-Identifier: MIT
#include "geometry/principal_axes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>

#include "support/random.hpp"
#include "support/reference_axes.hpp"

namespace dynamic_filter {
namespace principal_axes_test {

Moments moments_of(const Points& points, const Point& origin = Point::Zero()) {
    Moments m{.origin = origin};
    for (const Point& p : points) m.add(p);
    return m;
}

Points patch(test::Random& random, const Eigen::Vector3d& normal, const Eigen::Vector3d& at,
             double length, double width, double height, int count) {
    const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
    Points points;
    for (int i = 0; i < count; ++i) {
        const double a = random.uniform(-length, length), b = random.uniform(-width, width);
        const double c = random.uniform(-height, height);
        points.push_back((at + a * u + b * v + c * normal).cast<float>());
    }
    return points;
}

TEST(SmallestAxis, IsTheNormalOfAKnownPlane) {
    test::Random random(1);
    for (int i = 0; i < 300; ++i) {
        const Eigen::Vector3d normal = random.direction();
        const auto axis = smallest_axis(
            moments_of(patch(random, normal, random.point(5.0).cast<double>(), 0.5, 0.3, 0.0, 12)));
        ASSERT_TRUE(axis);
        EXPECT_NEAR(axis->norm(), 1.0, 1e-9);
        EXPECT_GT(std::abs(axis->dot(normal)), 1.0 - 1e-6);
    }
}

TEST(SmallestAxis, AgreesWithTheIterativeSolver) {
    test::Random random(2);
    for (int i = 0; i < 500; ++i) {
        const Points points = patch(random, random.direction(), random.point(20.0).cast<double>(),
                                    0.5, 0.4, 0.1, 3 + static_cast<int>(random.below(20)));
        const auto solver = test::reference_axes(points);
        const auto axis = smallest_axis(moments_of(points));
        ASSERT_TRUE(axis);
        if (solver.eigenvalues()[1] < 1.5 * solver.eigenvalues()[0]) continue;  // no clear axis
        EXPECT_GT(std::abs(axis->dot(solver.eigenvectors().col(0))), 1.0 - 1e-6);
    }
}

TEST(SmallestAxis, ThreePointsSpanAPlane) {
    const auto axis = smallest_axis(moments_of({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}));
    ASSERT_TRUE(axis);
    EXPECT_NEAR(std::abs(axis->z()), 1.0, 1e-9);
}

TEST(SmallestAxis, IsEmptyForFewerThanThreePoints) {
    EXPECT_FALSE(smallest_axis(moments_of({})));
    EXPECT_FALSE(smallest_axis(moments_of({{1, 2, 3}})));
    EXPECT_FALSE(smallest_axis(moments_of({{1, 2, 3}, {2, 2, 3}})));
}

TEST(SmallestAxis, IsEmptyForOneSpotAndForOneLine) {
    test::Random random(3);
    for (int i = 0; i < 200; ++i) {
        const Point spot = random.point(10.0);
        EXPECT_FALSE(smallest_axis(moments_of(Points(8, spot))));
        const Point along = random.direction().cast<float>();
        Points line;
        for (int k = 0; k < 8; ++k) line.push_back(spot + random.uniform_f(-1, 1) * along);
        EXPECT_FALSE(smallest_axis(moments_of(line)));
    }
}

TEST(SmallestAxis, AStripIsAPlaneButAThreadIsNot) {
    test::Random random(4);
    const Eigen::Vector3d normal(0, 0, 1), at(0, 0, 0);
    EXPECT_TRUE(smallest_axis(moments_of(patch(random, normal, at, 1.0, 1e-2, 0.0, 20))));
    EXPECT_FALSE(smallest_axis(moments_of(patch(random, normal, at, 1.0, 1e-4, 0.0, 20))));
    EXPECT_TRUE(smallest_axis(moments_of(patch(random, normal, at, 1e-3, 1e-3, 0.0, 20))));
    EXPECT_FALSE(smallest_axis(moments_of(patch(random, normal, at, 1e-7, 1e-7, 0.0, 20))));
}

TEST(SmallestAxis, IsEmptyForPointsThatAreNotNumbers) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(smallest_axis(moments_of({{0, 0, nan}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}})));
}

TEST(Moments, HoldSumsOfOffsetsFromTheOrigin) {
    const Moments m = moments_of({{1, 2, 3}, {3, 5, 9}}, {1, 1, 1});
    EXPECT_EQ(m.count, 2);
    EXPECT_EQ(m.sum, Eigen::Vector3d(2, 5, 10));
    Eigen::Matrix3d squares;
    squares << 4, 8, 16, 8, 17, 34, 16, 34, 68;
    EXPECT_EQ(m.sum_of_squares, squares);
}

TEST(Moments, AddedTogetherEqualThoseOfAllPoints) {
    test::Random random(5);
    Points first = random.points(20, 3.0);
    const Points second = random.points(30, 3.0);
    const Point origin(0.5F, -1.0F, 2.0F);
    Moments sum = moments_of(first, origin);
    sum += moments_of(second, origin);
    first.insert(first.end(), second.begin(), second.end());
    const Moments all = moments_of(first, origin);
    EXPECT_EQ(sum.count, all.count);
    EXPECT_TRUE(sum.sum.isApprox(all.sum, 1e-12));
    EXPECT_TRUE(sum.sum_of_squares.isApprox(all.sum_of_squares, 1e-12));
}

TEST(Moments, LargeCoordinatesLoseNothingNearTheOrigin) {
    test::Random random(6);
    const Point far(65536.0F, -65536.0F, 1024.0F);
    Points points, shifted;
    for (int i = 0; i < 20; ++i) {  // multiples of 1/64 stay exact far away
        const Point p(static_cast<float>(random.below(64)) / 64.0F,
                      static_cast<float>(random.below(64)) / 64.0F, 0.0F);
        points.push_back(p);
        shifted.push_back(p + far);
    }
    const Moments near_sums = moments_of(points), far_sums = moments_of(shifted, far);
    EXPECT_EQ(near_sums.sum, far_sums.sum);
    EXPECT_EQ(near_sums.sum_of_squares, far_sums.sum_of_squares);
}

}  // namespace principal_axes_test
}  // namespace dynamic_filter
