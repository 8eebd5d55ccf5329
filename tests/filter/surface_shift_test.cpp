// SPDX-License-Identifier: MIT
#include "filter/surface_shift.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "support/views_of_things.hpp"

namespace dynamic_filter {
namespace surface_shift_test {

using test::view_of_box;
using test::view_of_post;

const Point kInFront(0.0F, -8.0F, 0.8F);

TEST(SurfaceShift, NormalsLookTowardsTheSensor) {
    const Surface surface = surface_of(view_of_box({0, 3}, kInFront, 1), kInFront);
    ASSERT_GT(surface.points.size(), 40U);
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
        EXPECT_GT(surface.normals[i].dot(kInFront - surface.points[i]), 0.0F);
    }
}

TEST(SurfaceShift, PointsOnOneRingLieOnAnUprightSurface) {
    Points ring;
    for (int i = 0; i < 40; ++i) ring.emplace_back(0.05F * static_cast<float>(i), 3.0F, 0.8F);
    const Surface surface = surface_of(ring, kInFront);
    ASSERT_GT(surface.normals.size(), 20U);
    for (const Point& normal : surface.normals) EXPECT_LT(normal.y(), -0.99F);
}

TEST(SurfaceShift, ABoxThatShowsTwoSidesTellsItsWholeShift) {
    const Point from(-6.0F, -5.0F, 0.8F);
    const Surface surface = surface_of(view_of_box({0, 3}, from, 1), from);
    for (const Eigen::Vector2d& by :
         {Eigen::Vector2d(0.1, 0.0), Eigen::Vector2d(-0.05, 0.2), Eigen::Vector2d(0.0, -0.15)}) {
        const auto shift =
            shift_to(surface, view_of_box(Eigen::Vector2d(0, 3) + by, from, 2), from, {0, 0});
        ASSERT_TRUE(shift);
        EXPECT_LT((shift->by - by).norm(), 0.03) << by.transpose();
        EXPECT_GT(shift->weight(0, 0), 0.1);
        EXPECT_GT(shift->weight(1, 1), 0.1);
    }
}

TEST(SurfaceShift, AWallTellsNothingOfAMotionAlongIt) {
    const Surface surface = surface_of(view_of_box({0, 3}, kInFront, 1), kInFront);
    const auto shift = shift_to(surface, view_of_box({0.2, 3.1}, kInFront, 2), kInFront, {0, 0});
    ASSERT_TRUE(shift);
    EXPECT_NEAR(shift->by.y(), 0.1, 0.02);
    EXPECT_LT(shift->weight(0, 0), 0.01);
    EXPECT_GT(shift->weight(1, 1), 0.9);
}

TEST(SurfaceShift, WhatIsPassedDoesNotShift) {
    const Point first(-9.0F, -3.0F, 0.8F);
    const Surface surface = surface_of(view_of_box({0, 3}, first, 1), first);
    int compared = 0;
    for (float x = -8.0F; x < 9.0F; x += 1.0F) {
        const Point from(x, -3.0F, 0.8F);
        const auto shift = shift_to(surface, view_of_box({0, 3}, from, 2), from, {0, 0});
        if (!shift) continue;
        ++compared;
        EXPECT_LT((shift->weight * shift->by).norm(), 0.03) << x;
    }
    EXPECT_GT(compared, 6);
}

TEST(SurfaceShift, TheFarSideOfAPostIsNotItsNearSide) {
    const Point behind(0.0F, 14.0F, 0.8F);
    const Surface surface = surface_of(view_of_post({0, 3}, kInFront, 1), kInFront);
    ASSERT_GT(surface.points.size(), 20U);
    EXPECT_TRUE(shift_to(surface, view_of_post({0, 3}, kInFront, 2), kInFront, {0, 0}));
    EXPECT_FALSE(shift_to(surface, view_of_post({0, 3}, behind, 2), behind, {0, 0}));
}

TEST(SurfaceShift, WhatIsElsewhereHasNoShift) {
    const Surface surface = surface_of(view_of_box({0, 3}, kInFront, 1), kInFront);
    EXPECT_FALSE(shift_to(surface, view_of_box({0, 9}, kInFront, 1), kInFront, {0, 0}));
    EXPECT_FALSE(shift_to(surface, {}, kInFront, {0, 0}));
    EXPECT_FALSE(shift_to({}, view_of_box({0, 3}, kInFront, 1), kInFront, {0, 0}));
}

}  // namespace surface_shift_test
}  // namespace dynamic_filter
