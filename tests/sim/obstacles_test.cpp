// SPDX-License-Identifier: MIT
#include "sim/obstacles.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dynamic_filter::sim::obstacles_test {

using Eigen::Vector2d;

TEST(Obstacles, DistanceToDiscAndRectangle) {
    const Obstacle disc{.centre = {1, 0}, .radius = 0.5};
    EXPECT_NEAR(distance(disc, {3, 0}), 1.5, 1e-12);
    EXPECT_NEAR(distance(disc, {1, 0}), -0.5, 1e-12);
    const double s = std::sqrt(0.5);
    const Obstacle turned{.centre = {0, 0}, .half = {2, 1}, .axis = {s, s}};
    EXPECT_NEAR(distance(turned, {3 * s, 3 * s}), 1.0, 1e-12);
    EXPECT_NEAR(distance(turned, {-3 * s, 3 * s}), 2.0, 1e-12);
    EXPECT_NEAR(distance(turned, {0, 0}), -1.0, 1e-12);
}

TEST(Obstacles, FieldFollowsTheNearestObstacle) {
    const std::vector<Obstacle> obstacles = {{.centre = {2, 2}, .radius = 0.5},
                                             {.centre = {-2, 0}, .half = {0.3, 3}}};
    const DistanceField field = distance_field(obstacles, {-5, -5}, {5, 5});
    for (double x = -4.9; x < 4.9; x += 0.37) {
        for (double y = -4.9; y < 4.9; y += 0.41) {
            const Vector2d p(x, y);
            const double expected =
                std::min({distance(obstacles[0], p), distance(obstacles[1], p), 3.0});
            EXPECT_NEAR(field.at(p).distance, expected, 0.06);
        }
    }
    const auto away = field.at({3.0, 2.0}).away;
    EXPECT_NEAR(away.x(), 1.0, 0.05);
    EXPECT_NEAR(away.y(), 0.0, 0.05);
}

TEST(Obstacles, ClearOnlyWhereTheBodyFits) {
    const DistanceField field =
        distance_field({{.centre = {0, 0}, .radius = 1.0}}, {-5, -5}, {5, 5});
    EXPECT_FALSE(is_clear(field, {-4, 0}, {4, 0}, 0.2));
    EXPECT_TRUE(is_clear(field, {-4, 1.5}, {4, 1.5}, 0.2));
    EXPECT_FALSE(is_clear(field, {-4, 1.5}, {4, 1.5}, 0.7));
}

}  // namespace dynamic_filter::sim::obstacles_test
