// SPDX-License-Identifier: MIT
#include "geometry/beam_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamic_filter/motion.hpp"

namespace dynamic_filter {
namespace beam_axis_test {

/// 16 beams around `axis`, in all directions.
Points fan(Eigen::Index axis) {
    Points points;
    for (int beam = -15; beam <= 15; beam += 2) {
        const double elevation = beam * std::numbers::pi / 180.0;
        for (int i = 0; i < 360; i += 3) {
            const double azimuth = i * std::numbers::pi / 180.0;
            Point p;
            p[(axis + 1) % 3] = static_cast<float>(5.0 * std::cos(azimuth) * std::cos(elevation));
            p[(axis + 2) % 3] = static_cast<float>(5.0 * std::sin(azimuth) * std::cos(elevation));
            p[axis] = static_cast<float>(5.0 * std::sin(elevation));
            points.push_back(p);
        }
    }
    return points;
}

TEST(BeamAxis, IsTheOneAboutWhichBeamsFanOut) {
    for (const Eigen::Index axis : {0, 1, 2}) EXPECT_EQ(beam_axis(fan(axis)), axis);
}

TEST(BeamAxis, IsZWithoutEvidence) {
    EXPECT_EQ(beam_axis({}), 2);
    EXPECT_EQ(beam_axis({Point::Zero(), Point(std::nanf(""), 1.0F, 1.0F)}), 2);
    Points round;  // a field of view that is as high as wide, along x
    for (int i = 0; i < 100; ++i) {
        const double angle = 0.3 * i;
        round.emplace_back(5.0, 0.03 * i * std::cos(angle), 0.03 * i * std::sin(angle));
    }
    EXPECT_EQ(beam_axis(round), 2);
}

TEST(BeamAxis, TurnedScansShowTheSamePlacesOfTheWorld) {
    Twist displacement;
    displacement << 3.0, -2.0, 1.0, 0.4, -0.2, 0.7;
    for (const Eigen::Index axis : {0, 1, 2}) {
        const Scan scan{fan(axis), exp(displacement), 0.0, 7};
        const Scan turned = turned_to_z(scan, axis);
        EXPECT_EQ(turned.index, 7U);
        EXPECT_NEAR(turned.T_world_sensor.linear().determinant(), 1.0, 1e-12);
        EXPECT_EQ(beam_axis(turned.points), 2);
        for (std::size_t i = 0; i < scan.points.size(); i += 50) {
            const Eigen::Vector3d before = scan.T_world_sensor * scan.points[i].cast<double>();
            const Eigen::Vector3d after = turned.T_world_sensor * turned.points[i].cast<double>();
            EXPECT_LT((before - after).norm(), 1e-9);
        }
    }
}

}  // namespace beam_axis_test
}  // namespace dynamic_filter
