// SPDX-License-Identifier: MIT
#include "sim/social_force.hpp"

#include <gtest/gtest.h>

#include "sim/random.hpp"

namespace dynamic_filter::sim::social_force_test {

using Eigen::Vector2d;

TEST(SocialForce, PairsAreThoseOfAllAgainstAll) {
    Random random{2};
    std::vector<Vector2d> points;
    for (int i = 0; i < 200; ++i)
        points.emplace_back(random.uniform(-20, 20), random.uniform(-4, 4));
    std::vector<Pair> expected;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = i + 1; j < points.size(); ++j) {
            if ((points[i] - points[j]).norm() < 3.0) expected.emplace_back(i, j);
        }
    }
    EXPECT_EQ(pairs_within(points, 3.0), expected);
    EXPECT_TRUE(pairs_within({}, 3.0).empty());
}

TEST(SocialForce, PushesApartMoreSoWhenNearAndInFront) {
    const Vector2d ahead = Vector2d::UnitX();
    const Vector2d near = person_force(ahead, {-0.6, 0.0}, 0.2, false);
    const Vector2d far = person_force(ahead, {-1.4, 0.0}, 1.0, false);
    const Vector2d behind = person_force(ahead, {0.6, 0.0}, 0.2, false);
    EXPECT_LT(near.x(), far.x());
    EXPECT_LT(far.x(), 0.0);
    EXPECT_GT(behind.x(), 0.0);
    EXPECT_LT(behind.x(), -near.x());
}

TEST(SocialForce, OncomingPeopleStepRight) {
    EXPECT_LT(person_force(Vector2d::UnitX(), {-1.0, 0.0}, 0.6, true).y(), 0.0);
    EXPECT_GT(person_force(-Vector2d::UnitX(), {1.0, 0.0}, 0.6, true).y(), 0.0);
}

TEST(SocialForce, LeavesTheLaneOfAMover) {
    const Mover robot{.centre = {0, 0}, .velocity = {1, 0}, .radius = 0.4};
    EXPECT_GT(mover_force({1.5, 0.2}, 0.2, robot).y(), 0.5);
    EXPECT_LT(mover_force({1.5, -0.2}, 0.2, robot).y(), -0.5);
    EXPECT_EQ(mover_force({5.0, 0.0}, 0.2, robot), Vector2d(0, 0));
}

}  // namespace dynamic_filter::sim::social_force_test
