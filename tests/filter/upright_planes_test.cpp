// SPDX-License-Identifier: MIT
#include "filter/upright_planes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dynamic_filter::upright_planes_test {

using Eigen::Vector2f;

TEST(UprightPlanes, FindsTwoWallsAndHowFarTheyGo) {
    std::vector<Vector2f> points;
    for (int i = 0; i < 100; ++i) points.emplace_back(100.0F + 0.2F * static_cast<float>(i), 50.0F);
    const Vector2f along(0.6F, 0.8F);
    for (int i = 0; i < 60; ++i) {
        points.push_back(Vector2f(100.0F, 40.0F) + 0.2F * static_cast<float>(i) * along);
    }
    const auto planes = upright_planes(points, 5, 20);
    ASSERT_EQ(planes.size(), 2U);
    EXPECT_NEAR(std::abs(planes[0].normal.y()), 1.0F, 1e-3F);
    EXPECT_NEAR(planes[0].height({110.0F, 50.0F}), 0.0F, 1e-2F);
    EXPECT_NEAR(planes[0].until - planes[0].from, 19.8F, 0.1F);
    EXPECT_NEAR(std::abs(planes[1].normal.dot(along)), 0.0F, 1e-2F);
    EXPECT_NEAR(planes[1].until - planes[1].from, 11.8F, 0.6F);
}

TEST(UprightPlanes, TooFewPointsAreNone) {
    EXPECT_TRUE(upright_planes({}, 5, 20).empty());
    EXPECT_TRUE(upright_planes(std::vector<Vector2f>(10, Vector2f(1.0F, 2.0F)), 5, 20).empty());
}

TEST(UprightPlanes, NoMoreThanAskedFor) {
    std::vector<Vector2f> points;
    for (int wall = 0; wall < 4; ++wall) {
        for (int i = 0; i < 50; ++i) {
            points.emplace_back(0.2F * static_cast<float>(i), 5.0F * static_cast<float>(wall));
        }
    }
    EXPECT_EQ(upright_planes(points, 3, 20).size(), 3U);
    EXPECT_EQ(upright_planes(points, 9, 20).size(), 4U);
}

}  // namespace dynamic_filter::upright_planes_test
