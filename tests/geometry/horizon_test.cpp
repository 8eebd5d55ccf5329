// SPDX-License-Identifier: MIT
#include "geometry/horizon.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter {
namespace horizon_test {

Eigen::Vector3d at(double x) { return {x, 0.0, 0.0}; }

TEST(Horizon, TheMapIsCutAfterAQuarterOfTheRadius) {
    Horizon horizon(4.0, SIZE_MAX);
    EXPECT_FALSE(horizon.due(at(0.0), 1000));  // where it begins
    EXPECT_FALSE(horizon.due(at(0.9), 1000));
    const auto cut = horizon.due(at(1.1), 1000);
    ASSERT_TRUE(cut);
    EXPECT_EQ(cut->radius, 4.0);
    EXPECT_FALSE(horizon.due(at(2.0), 1000));  // 0.9 m on
    EXPECT_TRUE(horizon.due(at(2.2), 1000));
}

TEST(Horizon, AMapThatIsTooLargeIsCutToThreeQuarters) {
    Horizon horizon(0.0, 1000);
    EXPECT_FALSE(horizon.due(at(0.0), 1000));
    const auto cut = horizon.due(at(0.0), 1001);
    ASSERT_TRUE(cut);
    EXPECT_EQ(cut->most, 750U);
    EXPECT_GT(cut->radius, 1e6);
}

TEST(Horizon, WithoutLimitsNothingIsCut) {
    Horizon horizon;
    EXPECT_FALSE(horizon.due(at(0.0), 0));
    EXPECT_FALSE(horizon.due(at(1e6), SIZE_MAX));
}

}  // namespace horizon_test
}  // namespace dynamic_filter
