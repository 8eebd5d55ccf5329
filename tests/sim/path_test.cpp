// SPDX-License-Identifier: MIT
#include "sim/path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dynamic_filter::sim::path_test {

using Eigen::Vector2d;

TEST(Path, StadiumHasItsLengthAndCloses) {
    const Path path = stadium(10.0, 2.0, -5.0);
    EXPECT_NEAR(path.lengths.back(), 40.0 + 4.0 * std::numbers::pi, 0.01);
    EXPECT_NEAR((at(path, 0.0).position - Vector2d(-5, -2)).norm(), 0.0, 1e-9);
    EXPECT_NEAR((at(path, 3.0).position - Vector2d(-2, -2)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((at(path, path.lengths.back()).position - Vector2d(-5, -2)).norm(), 0.0, 1e-9);
}

TEST(Path, HeadingTurnsSmoothly) {
    for (const Path& path :
         {stadium(10.0, 1.8, -5.0), smooth_path({{0, 0}, {10, 0}, {20, 8}, {20, 20}}, false)}) {
        for (double s = 0.0; s + 0.1 < path.lengths.back(); s += 0.1) {
            const PathPoint a = at(path, s), b = at(path, s + 0.1);
            EXPECT_NEAR((b.position - a.position).norm(), 0.1, 0.002);
            EXPECT_GT(a.direction.dot(b.direction), 0.99);
            EXPECT_GT(a.direction.dot((b.position - a.position).normalized()), 0.99);
        }
    }
}

TEST(Path, OpenPathGoesOnStraightBeyondItsEnds) {
    const Path path = smooth_path({{0, 0}, {10, 0}, {20, 0}}, false);
    EXPECT_NEAR((at(path, -3.0).position - Vector2d(-3, 0)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((at(path, 23.0).position - Vector2d(23, 0)).norm(), 0.0, 1e-6);
}

TEST(Path, PolylineGoesStraightFromPointToPoint) {
    const Path path = polyline({{0, 0}, {3, 4}, {3, 10}});
    EXPECT_DOUBLE_EQ(path.lengths.back(), 11.0);
    EXPECT_NEAR((at(path, 5.0).position - Vector2d(3, 4)).norm(), 0.0, 1e-9);
    EXPECT_NEAR((at(path, 8.0).position - Vector2d(3, 7)).norm(), 0.0, 1e-9);
}

TEST(Path, LogTellsTheWay) {
    Ride ride{.path = {}, .start = 100.0, .speed = 50.0};
    ride.log = {.from = -1.0, .way = {5.0, 6.0, 6.0, 8.0}};
    EXPECT_NEAR(travelled(ride, -1.0), 5.0, 1e-9);
    EXPECT_NEAR(travelled(ride, -1.0 + 0.5 * log_step), 5.5, 1e-9);
    EXPECT_NEAR(travelled(ride, -1.0 + 1.5 * log_step), 6.0, 1e-9);
    EXPECT_NEAR(travelled(ride, -1.0 + 4.0 * log_step), 10.0, 1e-9);  // on as it was
    EXPECT_NEAR(travelled(ride, -1.0 - log_step), 4.0, 1e-9);
    EXPECT_NEAR(speed_at(ride, -1.0), 10.0, 1e-9);
    EXPECT_NEAR(speed_at(ride, -1.0 + 1.5 * log_step), 10.0, 1e-6);
    ride.log = {};
    EXPECT_EQ(speed_at(ride, 3.0), 50.0);
}

TEST(Path, HaltsWhenTheRideStands) {
    const Ride ride{.path = {}, .start = 10.0, .speed = 6.0, .stop_at = 70.0, .stop_time = 10.0};
    const double t = halts_at(ride);
    EXPECT_NEAR(travelled(ride, t), 70.0, 1e-9);
    EXPECT_LT(travelled(ride, t - 0.2), 69.99);
    EXPECT_EQ(travelled(ride, t + 9.9), 70.0);
}

TEST(Path, RideBrakesStandsAndGoesOn) {
    const Ride ride{.path = {}, .start = 10.0, .speed = 6.0, .stop_at = 70.0, .stop_time = 10.0};
    double before = travelled(ride, 0.0), speed = 6.0, standing = 0.0;
    EXPECT_EQ(before, 10.0);
    for (double t = 0.01; t < 40.0; t += 0.01) {
        const double s = travelled(ride, t), v = (s - before) / 0.01;
        EXPECT_GE(v, -1e-9);
        EXPECT_LT(std::abs(v - speed) / 0.01, 1.6);
        standing += v < 1e-6 ? 0.01 : 0.0;
        before = s;
        speed = v;
    }
    EXPECT_NEAR(standing, 10.0, 0.05);
    EXPECT_NEAR(speed, 6.0, 1e-6);
}

}  // namespace dynamic_filter::sim::path_test
