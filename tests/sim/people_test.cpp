// SPDX-License-Identifier: MIT
#include "sim/people.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::sim::people_test {

using Eigen::Vector2d;

TEST(People, SizesAndSpeedsAreThoseOfAdultsAndChildren) {
    Random random{1};
    int children = 0;
    for (int i = 0; i < 2000; ++i) {
        const Walker walker = draw_walker(random);
        const bool child = walker.height < 1.4;
        children += child;
        EXPECT_GE(walker.height, child ? 1.0 : 1.5);
        EXPECT_LE(walker.height, child ? 1.35 : 1.95);
        EXPECT_GE(walker.speed, 0.6);
        EXPECT_LE(walker.speed, 1.7);
    }
    EXPECT_NEAR(children, 200, 60);
}

TEST(People, CompanionsWalkAbreastAndFaceEachOther) {
    Random random{2};
    Walker leader = draw_walker(random);
    leader.company = 4;
    for (double x = 0.0; x < 30.0; x += 5.0) leader.route.push_back({.at = {x, 0.0}});
    leader.route[3].pause = 9.0;
    leader.route[3].face = leader.route[3].at + Vector2d(0.45, 0.0);
    const Walker other = companion(leader, 0.5, random);
    ASSERT_EQ(other.route.size(), leader.route.size());
    EXPECT_EQ(other.company, 4);
    EXPECT_EQ(other.route[3].pause, 9.0);
    EXPECT_NEAR((other.route[1].at - leader.route[1].at).norm(), 0.5, 1e-9);
    EXPECT_GT((other.route[3].at - leader.route[3].at).norm(), 0.45);
    EXPECT_LT((other.route[3].at - leader.route[3].face).norm(), 0.6);
}

TEST(People, ScatteredClearOfWallsAndOthers) {
    Random random{3};
    const DistanceField field =
        distance_field({{.centre = {0, 0}, .radius = 1.0}}, {-20, -5}, {20, 5});
    std::vector<Walker> walkers;
    for (int i = 0; i < 30; ++i) {
        Walker walker = draw_walker(random);
        walker.route = {{.at = {-18.0, random.uniform(-1, 1)}},
                        {.at = {18.0, random.uniform(-1, 1)}}};
        walkers.push_back(walker);
    }
    scatter(walkers, field, random);
    for (std::size_t i = 0; i < walkers.size(); ++i) {
        EXPECT_GE(field.at(walkers[i].start).distance, walkers[i].radius);
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_GT((walkers[i].start - walkers[j].start).norm(), 0.4);
    }
}

}  // namespace dynamic_filter::sim::people_test
