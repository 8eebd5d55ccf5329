// SPDX-License-Identifier: MIT
#include "navigation/columns.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::app {
namespace columns_test {

std::vector<Surface> surfaces_of(const Points& points) {
    Columns columns(0.1F);
    for (const Point& point : points) columns.add(point);
    return columns.surfaces();
}

TEST(Columns, PointsWithoutAGapAreOneSurface) {
    Points points;
    for (float z = 0.0F; z < 1.0F; z += 0.04F) points.emplace_back(0.05F, -0.05F, z);
    const auto wall = surfaces_of(points);
    ASSERT_EQ(wall.size(), 1U);
    EXPECT_EQ(wall[0].x, 0);
    EXPECT_EQ(wall[0].y, -1);
    EXPECT_NEAR(wall[0].bottom, 0.0F, 0.05F);
    EXPECT_NEAR(wall[0].top, 1.0F, 0.05F);
    EXPECT_EQ(wall[0].points, points.size());
}

TEST(Columns, WhatHangsAboveIsAnotherSurface) {
    const auto s = surfaces_of({{0, 0, 0.01F}, {0, 0, 2.0F}, {0.11F, 0, 0.01F}});
    ASSERT_EQ(s.size(), 3U);
    EXPECT_FLOAT_EQ(s[0].top, 0.01F);
    EXPECT_FLOAT_EQ(s[1].bottom, 2.0F);
    EXPECT_EQ(s[2].x, 1);
}

TEST(Columns, NoiseOfFlatGroundIsAveraged) {
    const auto s = surfaces_of({{0, 0, 0.04F}, {0, 0, 0.06F}, {0, 0, 0.05F}, {0, 0, 0.049F}});
    ASSERT_EQ(s.size(), 1U);
    EXPECT_NEAR(s[0].top, 0.05F, 0.002F);
    EXPECT_EQ(s[0].bottom, s[0].top);
}

TEST(Columns, ALowObjectIsNotAveragedWithTheGround) {
    const auto s = surfaces_of({{0, 0, 0.01F}, {0, 0, 0.13F}});
    ASSERT_EQ(s.size(), 1U);
    EXPECT_FLOAT_EQ(s[0].top, 0.13F);
}

TEST(Columns, AStrayPointDoesNotRaiseTheGround) {
    Points points(100, Point(0, 0, 0.02F));
    points.emplace_back(0.0F, 0.0F, 0.12F);
    const auto s = surfaces_of(points);
    ASSERT_EQ(s.size(), 1U);
    EXPECT_NEAR(s[0].top, 0.02F, 1e-4F);
}

TEST(Columns, PointsThatAreNotFiniteOrTooFarAreLeftOut) {
    EXPECT_TRUE(surfaces_of({{NAN, 0, 0}, {0, 1e7F, 0}}).empty());
}

}  // namespace columns_test
}  // namespace dynamic_filter::app
