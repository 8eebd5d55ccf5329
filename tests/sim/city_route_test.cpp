// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/city.hpp"

namespace dynamic_filter::sim::city {
namespace city_route_test {

Eigen::Vector2d position(const Route& route, double t) {
    return at(route.ride.path, travelled(route.ride, t)).position;
}

/// Streets that a route takes, as pairs of nodes.
std::set<std::pair<std::pair<double, double>, std::pair<double, double>>> streets(
    const Route& route) {
    std::set<std::pair<std::pair<double, double>, std::pair<double, double>>> out;
    for (const Leg& leg : route.legs) {
        const std::pair a{leg.from.x(), leg.from.y()}, b{leg.to.x(), leg.to.y()};
        out.insert(std::minmax(a, b));
    }
    return out;
}

TEST(CityRoute, IsAsLongAsAskedAndSmooth) {
    for (const double km : {0.1, 1.0, 5.0}) {
        const Route way = route(3, km, 2);
        EXPECT_NEAR(travelled(way.ride, way.duration) - travelled(way.ride, 0.0), 1000.0 * km, 2.0);
        double last = -1.0;
        for (double t = 0.0; t < way.duration; t += log_step) {
            const double speed =
                (travelled(way.ride, t + log_step) - travelled(way.ride, t)) / log_step;
            EXPECT_GE(speed, 0.0);
            EXPECT_LT(speed, 10.1);
            EXPECT_LT(last >= 0.0 ? std::abs(speed - last) / log_step : 0.0, 4.0) << t;
            last = speed;
        }
    }
}

TEST(CityRoute, TurnsSlowlyAndHaltsAtTimes) {
    const Route way = route(1, 5.0, 1);
    int halts = 0, turns = 0;
    bool halting = false, turning = false;
    for (double t = 0.0; t < way.duration; t += 0.1) {
        const double s = travelled(way.ride, t), speed = (travelled(way.ride, t + 0.1) - s) / 0.1;
        const auto a = at(way.ride.path, s).direction, b = at(way.ride.path, s + 1.0).direction;
        const bool turns_now = a.dot(b) < 0.995, halts_now = speed < 0.05;
        EXPECT_LT(turns_now ? speed : 0.0, 6.5) << t;
        turns += turns_now && !turning;
        halts += halts_now && !halting;
        turning = turns_now, halting = halts_now;
    }
    EXPECT_GT(turns, 10);
    EXPECT_GE(halts, 2);
    EXPECT_LT(halts, 20);
    EXPECT_GT(1000.0 * 5.0 / way.duration, 6.0);  // [m/s] on average
}

TEST(CityRoute, KeepsToTheStreetsOnTheRight) {
    const Route way = route(1, 2.0, 1);
    for (double t = 0.0; t < way.duration; t += 0.3) {
        EXPECT_DOUBLE_EQ(ground(position(way, t)), 0.0) << t;
    }
    for (const Leg& leg : way.legs) {
        const Eigen::Vector2d d = (leg.to - leg.from).normalized();
        const double middle = 0.5 * (leg.enters + leg.leaves);
        const Eigen::Vector2d off = position(way, middle) - leg.from;
        EXPECT_NEAR(off.x() * d.y() - off.y() * d.x(), lane, 0.01);
    }
}

TEST(CityRoute, DrivesTakeTheSameStreetsInOtherOrders) {
    const Route one = route(1, 5.0, 1), two = route(1, 5.0, 2);
    EXPECT_NE(one.ride.path.points, two.ride.path.points);
    EXPECT_EQ(one.ride.path.points, route(1, 5.0, 1).ride.path.points);
    const auto a = streets(one), b = streets(two);
    std::vector<decltype(a)::value_type> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    EXPECT_GT(static_cast<double>(both.size()), 0.8 * static_cast<double>(a.size()));
    EXPECT_LT(a.size(), one.legs.size());  // some streets twice
}

TEST(CityRoute, TheLongestDriveStaysWithinTheNumberedBlocks) {
    EXPECT_EQ(blocks_across(0.01), 1);
    EXPECT_LE(blocks_across(80.0) + 2 * reserve, most_blocks);
}

}  // namespace city_route_test
}  // namespace dynamic_filter::sim::city
