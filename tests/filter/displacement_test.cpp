// SPDX-License-Identifier: MIT
#include "filter/displacement.hpp"

#include <gtest/gtest.h>

#include "support/views_of_things.hpp"

namespace dynamic_filter {
namespace displacement_test {

using Eigen::Vector2d;
using test::Random;
using test::view_of_box;
using test::view_of_post;

constexpr double kEvery = 0.4;  // [s]

/// The sensor passes a box that moves; the poses are off by `noise` [m] in each view.
std::vector<SteadyWay> pass(const Vector2d& velocity, double noise, int views) {
    Random random(5);
    FollowedSurface followed;
    std::vector<SteadyWay> ways;
    for (int i = 0; i < views; ++i) {
        const double t = kEvery * i;
        const Point from(static_cast<float>(-8.0 + t), -3.0F, 0.8F);
        const Vector2d off(random.uniform(-noise, noise), random.uniform(-noise, noise));
        const auto seed = static_cast<std::uint64_t>(i);
        const auto way =
            followed.look(t, from, view_of_box(Vector2d(0, 2) + velocity * t + off, from, seed));
        if (way) ways.push_back(*way);
    }
    return ways;
}

std::ptrdiff_t times_moved(const std::vector<SteadyWay>& ways) {
    std::ptrdiff_t times = 0;
    for (const SteadyWay& way : ways) {
        times += static_cast<std::ptrdiff_t>(
            which_moved(std::vector{way, SteadyWay{}, SteadyWay{}}, 0.15).size());
    }
    return times;
}

TEST(Displacement, WhatStandsStillDoesNotMove) {
    const auto ways = pass({0, 0}, 0.0, 40);
    EXPECT_GT(ways.size(), 15U);
    EXPECT_EQ(times_moved(ways), 0);
}

TEST(Displacement, NoiseOfThePosesIsNoMotion) {
    for (const double noise : {0.05, 0.1}) EXPECT_EQ(times_moved(pass({0, 0}, noise, 40)), 0);
}

// The shadow of something slow moves along a box: in each view, only a strip is seen beside it.
TEST(Displacement, AShadowThatMovesIsNoMotion) {
    const Point from(-6.0F, -5.0F, 0.8F);
    FollowedSurface followed;
    for (int i = 0; i < 30; ++i) {
        const float shadow = -2.0F + 0.04F * static_cast<float>(i);
        Points strip;
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            const auto all = view_of_box({0, 3}, from, 10 * static_cast<std::uint64_t>(i) + seed);
            for (const Point& p : all) {
                if (p.x() >= shadow && p.x() < shadow + 1.0F) strip.push_back(p);
            }
        }
        const auto way = followed.look(kEvery * i, from, strip);
        if (way) {
            EXPECT_EQ(times_moved({*way}), 0) << i;
        }
    }
}

TEST(Displacement, SlowMotionIsMeasured) {
    for (const Vector2d& velocity : {Vector2d(0.1, 0), Vector2d(0, 0.1), Vector2d(-0.05, 0.05)}) {
        const auto ways = pass(velocity, 0.0, 12);
        ASSERT_FALSE(ways.empty());
        EXPECT_GT(times_moved(ways), 0) << velocity.transpose();
        EXPECT_NEAR(ways.back().speed, velocity.norm(), 0.03) << velocity.transpose();
        EXPECT_NEAR(ways.back().length, ways.back().speed * 11 * kEvery, 1e-6);
    }
}

TEST(Displacement, SlowMotionIsFoundDespiteNoise) {
    EXPECT_GT(times_moved(pass({0.1, 0.1}, 0.05, 15)), 0);
}

TEST(Displacement, AMotionAlongAWallIsNotKnown) {
    SteadyMotion motion;
    Shift shift;
    shift.weight(1, 1) = 1.0;
    for (int i = 1; i < 12; ++i) {
        shift.by = {0.3 * i, 0.04 * i};  // along the wall: whatever the search began with
        motion.add(kEvery * i, shift);
    }
    const auto way = motion.way();
    ASSERT_TRUE(way);
    EXPECT_NEAR(way->speed, 0.1, 1e-3);
}

TEST(Displacement, FewShiftsTellNothing) {
    SteadyMotion motion;
    EXPECT_FALSE(motion.way());
    for (int i = 1; i < 5; ++i) {
        motion.add(kEvery * i, {.by = {0.1 * i, 0.0}, .weight = Eigen::Matrix2d::Identity()});
    }
    EXPECT_FALSE(motion.way());
    motion.add(2.0, {.by = {0.5, 0.0}, .weight = Eigen::Matrix2d::Identity()});
    EXPECT_TRUE(motion.way());
}

TEST(Displacement, AnotherViewTakesThePlaceOfOneThatCannotBeCompared) {
    FollowedSurface followed;
    const Point front(0.0F, -8.0F, 0.8F), behind(0.0F, 14.0F, 0.8F);
    for (int i = 0; i < 20; ++i) {
        const Point& from = i < 10 ? front : behind;
        const auto seed = static_cast<std::uint64_t>(i);
        const auto way = followed.look(kEvery * i, from, view_of_post({0, 3}, from, seed));
        if (i == 9 || i == 19) {
            ASSERT_TRUE(way) << i;
            EXPECT_LT(way->length, 0.05) << i;
        }
        if (i == 10 || i == 11) {
            EXPECT_FALSE(way) << i;
        }
    }
}

TEST(Displacement, IfAllSeemToMoveNoneDoes) {
    const std::vector<SteadyWay> drift(8, {.length = 0.4, .error = 0.02, .speed = 0.1});
    EXPECT_TRUE(which_moved(drift, 0.15).empty());
    std::vector<SteadyWay> one(8, {.length = 0.02, .error = 0.02, .speed = 0.005});
    one[3] = drift[0];
    EXPECT_EQ(which_moved(one, 0.15), std::vector<std::size_t>{3});
    EXPECT_TRUE(which_moved(one, 0.5).empty());
    one[3].error = 0.09;
    EXPECT_TRUE(which_moved(one, 0.15).empty());
    EXPECT_TRUE(which_moved({}, 0.15).empty());
}

}  // namespace displacement_test
}  // namespace dynamic_filter
