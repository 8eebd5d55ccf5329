// SPDX-License-Identifier: MIT
#include "check/beam_origins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/rings.hpp"

namespace dynamic_filter::io {
namespace beam_origins_test {

TEST(BeamOrigins, TheOriginIsExactlyTheOrigin) {
    for (const int beams : {16, 32, 64}) {
        const auto found = beam_origins(scan_of(beams, 1));
        ASSERT_EQ(found.size(), 1U) << beams;
        EXPECT_EQ(found.front(), Eigen::Vector3d::Zero()) << beams;
    }
}

TEST(BeamOrigins, ASensorElsewhereIsFoundToACentimetre) {
    for (const int beams : {16, 32, 64}) {
        for (const Point& at :
             {Point(0.9F, 0.0F, 1.6F), Point(-1.2F, 1.0F, 1.2F), Point(0, 0, 2)}) {
            const auto found = beam_origins(moved(scan_of(beams, 2), at));
            ASSERT_EQ(found.size(), 1U) << beams << " beams at " << at.transpose();
            EXPECT_LT((found.front() - at.cast<double>()).norm(), 0.01) << at.transpose();
        }
    }
}

TEST(BeamOrigins, ATiltedSensorIsFound) {
    const Eigen::Matrix3f turn(Eigen::AngleAxisf(0.07F, Eigen::Vector3f(1, 2, 0).normalized()));
    Points points = scan_of(32, 3);
    for (Point& p : points) p = turn * p + Point(0.5F, 0.2F, 1.0F);
    const auto found = beam_origins(points);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_LT((found.front() - Eigen::Vector3d(0.5, 0.2, 1.0)).norm(), 0.02);
}

TEST(BeamOrigins, TwoSensorsHaveTwoPlaces) {
    Points points = scan_of(16, 4);
    const Points second = moved(scan_of(16, 5), {2.0F, 0.0F, 0.5F});
    points.insert(points.end(), second.begin(), second.end());
    const auto found = beam_origins(points);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_LT(found[0].norm(), 0.01);
    EXPECT_LT((found[1] - Eigen::Vector3d(2.0, 0.0, 0.5)).norm(), 0.01);
}

TEST(BeamOrigins, HalvesOfOneSweepAreNoTwoSensors) {
    Points points = scan_of(32, 9);
    for (std::size_t i = points.size() / 2; i < points.size(); ++i) points[i].x() += 1.0F;
    EXPECT_LT(beam_origins(points).size(), 2U);
}

TEST(BeamOrigins, NothingIsSaidWithoutRingsInOrder) {
    Points shuffled = moved(scan_of(32, 6), {0.9F, 0.0F, 1.6F});
    std::mt19937 random(7);
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    EXPECT_TRUE(beam_origins(shuffled).empty());
    Points ground;  // circles on a plane tell no height
    for (const Point& p : moved(scan_of(32, 8, 0.0F), {0.9F, 0.0F, 1.6F})) {
        if (std::abs(p.z() + 0.1F) < 0.05F && std::abs(p.y()) < 6.0F) ground.push_back(p);
    }
    EXPECT_TRUE(beam_origins(ground).empty());
    EXPECT_TRUE(beam_origins({}).empty());
}

}  // namespace beam_origins_test
}  // namespace dynamic_filter::io
