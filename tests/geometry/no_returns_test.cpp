// SPDX-License-Identifier: MIT
#include "geometry/no_returns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace dynamic_filter {
namespace no_returns_test {

/// 16 beams of 200 directions each in a room of 40 m x 20 m; those above `from` degrees have no
/// return and end at 100 m.
Points scan(double from) {
    Points points;
    for (int beam = 0; beam < 16; ++beam) {
        const double degrees = -15.0 + 2.0 * beam;
        const double elevation = degrees * std::numbers::pi / 180.0;
        for (int i = 0; i < 200; ++i) {
            const double azimuth = 2.0 * std::numbers::pi * (i + 0.3) / 200.0;
            const Eigen::Vector3d direction(std::cos(azimuth) * std::cos(elevation),
                                            std::sin(azimuth) * std::cos(elevation),
                                            std::sin(elevation));
            const double wall =
                std::min(20.0 / std::abs(direction.x()), 10.0 / std::abs(direction.y()));
            const double ground = direction.z() < 0.0 ? 1.5 / -direction.z() : 1e9;
            points.push_back(
                (direction * (degrees > from ? 100.0 : std::min(wall, ground))).cast<float>());
        }
    }
    return points;
}

TEST(NoReturns, AtTheGreatestRangeBecomePointsWithoutMeasurement) {
    Points points = scan(10.0);
    const Points before = points;
    EXPECT_EQ(drop_no_returns(points), 600U);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool had_none = i / 200 > 12;
        EXPECT_EQ(is_measured(points[i]), !had_none) << i;
        EXPECT_TRUE(had_none || points[i] == before[i]) << i;
    }
    EXPECT_EQ(drop_no_returns(points), 0U);
}

TEST(NoReturns, AreFoundAmongCoordinatesThatAreRounded) {
    Points points = scan(10.0);
    for (Point& p : points) p = (p * 1000.0F).array().round() / 1000.0F;
    EXPECT_EQ(drop_no_returns(points), 600U);
}

TEST(NoReturns, SurfacesStay) {
    Points points = scan(90.0);
    const Points before = points;
    EXPECT_EQ(drop_no_returns(points), 0U);
    EXPECT_EQ(points, before);
    // One beam on a flat ground around the sensor.
    Points ring;
    for (int i = 0; i < 1000; ++i) {
        ring.emplace_back(20.0 * std::cos(0.001 * i), 20.0 * std::sin(0.001 * i), -1.5);
    }
    EXPECT_EQ(drop_no_returns(ring), 0U);
}

TEST(NoReturns, OddPointsAreLeftAlone) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    Points points(100, Point(nan, 1.0F, 2.0F));
    points.resize(200, Point(infinite, 0.0F, 0.0F));
    points.resize(300, Point::Zero());
    EXPECT_EQ(drop_no_returns(points), 0U);
    EXPECT_EQ(points[150].x(), infinite);
    Points none;
    EXPECT_EQ(drop_no_returns(none), 0U);
}

}  // namespace no_returns_test
}  // namespace dynamic_filter
