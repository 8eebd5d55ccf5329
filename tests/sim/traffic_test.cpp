// SPDX-License-Identifier: MIT
#include "sim/traffic.hpp"

#include <gtest/gtest.h>

#include "sim/vehicle_checks.hpp"

namespace dynamic_filter::sim::traffic_test {

namespace {

Driver car(double start, double y = -2.0) {
    Driver driver;
    driver.start = start;
    driver.y = y;
    return driver;
}

double x_of(const Ride& ride, double t) { return at(ride.path, travelled(ride, t)).position.x(); }

/// When the ride goes on after it has stood at some time before `t`.
double leaves(const Ride& ride, double t) {
    while (travelled(ride, t + 0.1) - travelled(ride, t) < 1e-6) t += 0.1;
    return t;
}

}  // namespace

TEST(Traffic, WhoIsAloneDrivesAtTheOwnSpeed) {
    for (const double way : {1.0, -1.0}) {
        Driver driver = car(0.0);
        driver.way = way;
        const Ride ride = drive({driver}, {}, 0.0, 30.0).front();
        EXPECT_NEAR(x_of(ride, 0.0), 0.0, 1e-6);
        EXPECT_NEAR(x_of(ride, 20.0), way * 140.0, 2.0);
        EXPECT_NEAR(at(ride.path, 50.0).position.y(), -2.0, 1e-9);
        EXPECT_NEAR(at(ride.path, 50.0).direction.x(), way, 1e-9);
    }
}

TEST(Traffic, AQueueStandsAtRedAndPullsOffOneAfterAnother) {
    const Signal signal{.at = 100.0, .cycle = 100.0, .red = 40.0, .first = 0.0};
    std::vector<Driver> drivers;
    for (int i = 0; i < 6; ++i) drivers.push_back(car(60.0 - 14.0 * i));
    const auto rides = drive(drivers, {signal}, 0.0, 80.0);
    double before = 40.0;
    for (std::size_t i = 0; i < rides.size(); ++i) {
        EXPECT_NEAR(travelled(rides[i], 39.0), travelled(rides[i], 30.0), 1e-9) << i;
        const double front = x_of(rides[i], 35.0) + half_footprint(VehicleKind::car).x();
        EXPECT_LT(front, 100.0 - stop_line - 0.3);
        EXPECT_GT(front, 95.0 - 8.0 * static_cast<double>(i) - 4.0);
        const double left = leaves(rides[i], 35.0);
        EXPECT_GE(left, before + (i > 0 ? 0.2 : 0.0)) << i;
        EXPECT_LT(left, before + 3.0) << i;
        before = left;
        EXPECT_GT(x_of(rides[i], 79.0), 100.0) << i;
        if (i == 0) continue;
        for (double t = 0.0; t < 80.0; t += 0.1) {
            EXPECT_GT(clearance(outline(VehicleKind::car, rides[i], t),
                                outline(VehicleKind::car, rides[i - 1], t)),
                      0.8)
                << i << " " << t;
        }
    }
}

TEST(Traffic, AHaltLastsItsTimeAndHoldsUpTheNext) {
    Driver bus = car(0.0);
    bus.kind = VehicleKind::bus;
    bus.halts = {{.at = 100.0, .time = 40.0}};
    const auto rides = drive({bus, car(-20.0)}, {}, 0.0, 120.0);
    const auto bus_rests = rests(rides[0], 120.0), car_rests = rests(rides[1], 120.0);
    ASSERT_EQ(bus_rests.size(), 1U);
    EXPECT_NEAR(bus_rests[0].until - bus_rests[0].from, 40.0, 1.0);
    EXPECT_NEAR(at(rides[0].path, bus_rests[0].s).position.x(), 100.0, 1.6);
    ASSERT_EQ(car_rests.size(), 1U);
    EXPECT_GT(car_rests[0].until, bus_rests[0].until);
}

TEST(Traffic, WhoLeavesTheKerbGivesWayAndSwerves) {
    Driver parked = car(50.0, -5.2);
    parked.moving = false;
    parked.swerves = {{51.0, 65.0, -2.0}};
    parked.halts = {{.at = 50.0, .not_before = 5.0, .gives_way = true}};
    std::vector<Driver> drivers = {parked};
    for (int i = 0; i < 4; ++i) drivers.push_back(car(30.0 - 12.0 * i));
    const auto rides = drive(drivers, {}, 0.0, 60.0);
    EXPECT_GT(leaves(rides[0], 0.0), 9.0);  // when the last one has passed
    EXPECT_NEAR(at(rides[0].path, travelled(rides[0], 40.0)).position.y(), -2.0, 1e-6);
    for (double t = 0.0; t < 60.0; t += 0.1) {
        const Obstacle own = outline(VehicleKind::car, rides[0], t);
        for (std::size_t i = 1; i < rides.size(); ++i)
            ASSERT_GT(clearance(own, outline(VehicleKind::car, rides[i], t)), 0.2) << t;
    }
}

TEST(Traffic, WhoDrawsUpLetsTheLaneGoOn) {
    Driver van = car(0.0);
    van.kind = VehicleKind::van;
    van.swerves = {{84.0, 98.5, -5.2}, {100.8, 115.0, -2.0}};
    van.halts = {{.at = 82.0, .gives_way = true}, {.at = 100.0, .time = 30.0, .gives_way = true}};
    Driver cyclist = car(10.0, -3.7);
    cyclist.kind = VehicleKind::cyclist;
    cyclist.speed = 4.5;
    const auto rides = drive({van, car(-15.0), cyclist}, {}, 0.0, 90.0);
    EXPECT_NEAR(at(rides[0].path, travelled(rides[0], 35.0)).position.y(), -5.2, 0.05);
    EXPECT_GT(x_of(rides[1], 40.0), 110.0);
    EXPECT_GT(x_of(rides[0], 89.0), 150.0);
    for (double t = 0.0; t < 90.0; t += 0.1) {
        const Obstacle own = outline(VehicleKind::van, rides[0], t);
        ASSERT_GT(clearance(own, outline(VehicleKind::car, rides[1], t)), 0.2) << t;
        ASSERT_GT(clearance(own, outline(VehicleKind::cyclist, rides[2], t)), 0.1) << t;
    }
}

TEST(Traffic, NobodyHaltsOnTheCrossing) {
    const Signal first{.at = 60.0, .cycle = 200.0, .red = 5.0, .first = 190.0};
    const Signal second{.at = 80.0, .cycle = 200.0, .red = 50.0, .first = 0.0};
    std::vector<Driver> drivers;
    for (int i = 0; i < 5; ++i) drivers.push_back(car(40.0 - 14.0 * i));
    const auto rides = drive(drivers, {first, second}, 0.0, 45.0);
    for (const Ride& ride : rides) {
        const double x = x_of(ride, 44.0);
        EXPECT_TRUE(x - 2.15 > 62.0 || x + 2.15 < 60.0 - stop_line) << x;
    }
}

}  // namespace dynamic_filter::sim::traffic_test
