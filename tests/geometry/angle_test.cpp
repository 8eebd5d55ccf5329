// SPDX-License-Identifier: MIT
#include "geometry/angle.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace dynamic_filter {
namespace angle_test {

TEST(Angle, IsTheNearestFloat) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> of(-1.0F, 1.0F);
    for (int i = 0; i < 100000; ++i) {
        const float y = of(random), x = of(random);
        ASSERT_EQ(angle_of(y, x), static_cast<float>(atan2l(y, x))) << y << " " << x;
        ASSERT_EQ(angle_of_tangent(y / x), static_cast<float>(atanl(y / x))) << y / x;
        ASSERT_EQ(angle_of_sine(x), static_cast<float>(asinl(x))) << x;
    }
}

TEST(Angle, HasTheSenseOfAtan2) {
    EXPECT_EQ(angle_of(0.0F, 0.0F), 0.0F);
    EXPECT_FLOAT_EQ(angle_of(1.0F, 0.0F), std::numbers::pi_v<float> / 2.0F);
    EXPECT_FLOAT_EQ(angle_of(0.0F, -1.0F), std::numbers::pi_v<float>);
    EXPECT_FLOAT_EQ(angle_of(-1.0F, -1.0F), -0.75F * std::numbers::pi_v<float>);
}

}  // namespace angle_test
}  // namespace dynamic_filter
