// SPDX-License-Identifier: MIT
#include "sim/sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dynamic_filter::sim::sensors_test {

namespace {

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

}  // namespace

TEST(Sensors, BeamsHaveTheElevationsOfTheTable) {
    for (const Sensor& sensor : sensor_table()) {
        if (sensor.beams == 0) continue;
        const auto rays = ray_directions(sensor, 1, 3);
        const auto beams = static_cast<std::size_t>(sensor.beams);
        ASSERT_EQ(rays.size(), beams * static_cast<std::size_t>(sensor.columns));
        const double spacing = (sensor.bottom_deg - sensor.top_deg) / (sensor.beams - 1);
        for (std::size_t i = 0; i < rays.size(); i += 7) {
            const double expected = sensor.top_deg + spacing * static_cast<double>(i % beams);
            EXPECT_NEAR(degrees(std::asin(static_cast<double>(rays[i].z()))), expected, 1e-4);
            EXPECT_NEAR(rays[i].norm(), 1.0F, 1e-6F);
        }
    }
}

TEST(Sensors, RosetteStaysInItsFieldAndNeverRepeats) {
    const Sensor& solid = sensor_table().back();
    ASSERT_EQ(solid.name, "solid");
    const auto a = ray_directions(solid, 1, 0), b = ray_directions(solid, 1, 1);
    ASSERT_EQ(a.size(), 24000U);
    double widest = 0.0, highest = 0.0;
    std::size_t same = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const auto d = a[i].cast<double>();
        widest = std::max(widest, std::abs(degrees(std::atan2(d.y(), d.x()))));
        highest = std::max(highest, std::abs(degrees(std::asin(d.z()))));
        same += (a[i] - b[i]).norm() < 1e-4F;
    }
    EXPECT_NEAR(widest, 35.2, 0.5);
    EXPECT_NEAR(highest, 38.6, 0.5);
    EXPECT_LT(same, 100U);
}

TEST(Sensors, TurningSensorStartsEachScanElsewhere) {
    const Sensor& sensor = sensor_table().front();
    EXPECT_NE(ray_directions(sensor, 1, 0)[0], ray_directions(sensor, 1, 1)[0]);
    EXPECT_EQ(ray_directions(sensor, 1, 1)[0], ray_directions(sensor, 1, 1)[0]);
}

}  // namespace dynamic_filter::sim::sensors_test
