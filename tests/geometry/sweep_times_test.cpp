// SPDX-License-Identifier: MIT
#include "dynamic_filter/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace dynamic_filter {
namespace sweep_times_test {

constexpr double kTurn = 2.0 * std::numbers::pi;

TEST(SweepTimes, FollowTheSensorAsItTurns) {
    for (const bool clockwise : {false, true}) {
        for (const double seam : {-3.0, 0.0, 1.0, 4.5}) {
            Points points;
            for (int i = 0; i < 100; ++i) {
                const double turned = kTurn * (i + 0.5) / 100.0;
                const double azimuth = seam + (clockwise ? -turned : turned);
                points.emplace_back(5.0 * std::cos(azimuth), 5.0 * std::sin(azimuth), 1.0 * i);
            }
            const auto times = sweep_times(points, {clockwise, seam, 0.1});
            ASSERT_EQ(times.size(), points.size());
            for (std::size_t i = 0; i < times.size(); ++i) {
                const double expected = 0.1 * ((static_cast<double>(i) + 0.5) / 100.0 - 0.5);
                EXPECT_NEAR(static_cast<double>(times[i]), expected, 1e-6) << seam;
            }
        }
    }
}

TEST(SweepTimes, AreShiftedTogether) {
    const Points points = {{1, 1, 0}, {-1, 1, 0}};
    const auto middle = sweep_times(points, {.duration = 0.1});
    const auto begin = sweep_times(points, {.duration = 0.1, .shift = 0.05});
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(begin[i] - middle[i], 0.05, 1e-6);
    // Few points show no order.
    EXPECT_EQ(sweep_times(points, {.in_order = true}), std::vector<float>(2, 0.0F));
}

TEST(SweepTimes, WhatIsNotMeasuredHasTimeZero) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const auto times = sweep_times({{kNan, 1, 1}, Point::Zero(), {-1, 0.1F, 0}}, {});
    EXPECT_EQ(times[0], 0.0F);
    EXPECT_EQ(times[1], 0.0F);
    EXPECT_NE(times[2], 0.05F);
    EXPECT_TRUE(sweep_times({}, {}).empty());
}

}  // namespace sweep_times_test
}  // namespace dynamic_filter
