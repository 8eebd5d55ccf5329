// SPDX-License-Identifier: MIT
#include "geometry/scan_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace dynamic_filter {
namespace scan_order_test {

constexpr double kDegree = std::numbers::pi / 180.0;

Point seen(double azimuth_deg, double elevation_deg) {
    const double azimuth = azimuth_deg * kDegree, elevation = elevation_deg * kDegree;
    return (10.0 * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                   std::cos(elevation) * std::sin(azimuth), std::sin(elevation)))
        .cast<float>();
}

/// Lasers of one firing point apart by some degrees.
double offset_deg(int laser) { return (laser * 7) % 13 - 6.0; }

TEST(ScanOrder, OfPointsAsTheyWereMeasured) {
    for (const double sense : {-1.0, 1.0}) {
        for (const double whole : {360.0, 395.0, 700.0}) {
            Points points;
            for (int k = 0; k < 2000; ++k) {
                for (int laser = 0; laser < 16; ++laser) {
                    points.push_back(
                        seen(77.0 + sense * whole * k / 2000.0 + offset_deg(laser), laser - 8.0));
                }
            }
            const auto shares = order_shares(points);
            ASSERT_EQ(shares.size(), points.size());
            for (std::size_t i = 0; i < shares.size(); ++i) {
                EXPECT_NEAR(shares[i], static_cast<double>(i / 16) / 2000.0, 0.01) << whole;
            }
        }
    }
}

TEST(ScanOrder, OfRowsWithTheirOwnBegins) {
    for (const double sense : {-1.0, 1.0}) {
        Points points;
        for (int laser = 0; laser < 16; ++laser) {
            for (int k = 0; k < 1800; ++k) {
                points.push_back(seen(77.0 + sense * 0.2 * k + offset_deg(laser), laser - 8.0));
            }
        }
        const auto shares = order_shares(points);
        ASSERT_EQ(shares.size(), points.size());
        for (std::size_t i = 0; i < shares.size(); ++i) {
            EXPECT_NEAR(shares[i], static_cast<double>(i % 1800) / 1800.0, 0.005) << i;
        }
    }
}

TEST(ScanOrder, PointsThatAreNotMeasuredTakeNoPart) {
    Points points;
    for (int k = 0; k < 3600; ++k) {
        points.push_back(k % 3 == 0 ? Point::Zero() : seen(0.1 * k, 0.0));
    }
    const auto shares = order_shares(points);
    ASSERT_EQ(shares.size(), points.size());
    EXPECT_EQ(shares[0], 0.5F);
    EXPECT_NEAR(shares[3599], 1.0, 0.01);
}

TEST(ScanOrder, WhatShowsNoOrder) {
    EXPECT_TRUE(order_shares({}).empty());
    Points points;
    for (int k = 0; k < 3600; ++k) points.push_back(seen(0.1 * k, k % 7));
    EXPECT_FALSE(order_shares(points).empty());
    std::shuffle(points.begin(), points.end(), std::mt19937(7));
    EXPECT_TRUE(order_shares(points).empty());
}

}  // namespace scan_order_test
}  // namespace dynamic_filter
