// SPDX-License-Identifier: MIT
#include "sim/jam.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim::jam {
namespace {

/// Lights that turn red at different times, so that drivers who pass one light stop at the next.
void add_signals(Plan& plan, Random& random) {
    double green = random.uniform(36.0, 42.0);
    for (const double x : {30.0, 130.0, 230.0}) {
        Signal signal{.at = x + random.uniform(-3.0, 3.0)};
        signal.first = green - signal.red;
        plan.signals.push_back(signal);
        plan.free.push_back({1.0, signal.at - 9.0, signal.at + 9.0});
        plan.free.push_back({-1.0, signal.at - 9.0, signal.at + 9.0});
        green += random.uniform(54.0, 62.0);
    }
}

/// A driver in the lane in direction `way`, at x when the traffic begins.
Driver in_lane(VehicleKind kind, double way, double x, Random& random) {
    const bool cyclist = kind == VehicleKind::cyclist;
    return {.kind = kind,
            .way = way,
            .start = way * x,
            .y = -way * (cyclist ? cycle_lane : lane),
            .speed = cyclist ? random.uniform(3.8, 5.0) : random.uniform(6.5, 7.8),
            .gap = cyclist ? random.uniform(0.6, 1.2) : random.uniform(1.5, 2.6)};
}

VehicleKind any_kind(Random& random) {
    return random.chance(0.2) ? VehicleKind::van : VehicleKind::car;
}

/// A column of mostly cars, one behind the other from x on; the first one is the foremost.
void add_column(Plan& plan, double way, double x, int count, Random& random) {
    for (int i = 0; i < count; ++i) {
        plan.drivers.push_back(in_lane(any_kind(random), way, x, random));
        x -= way * random.uniform(13.0, 19.0);
    }
}

double at_kerb(VehicleKind kind, double way) {
    return -way * (parking + (kind == VehicleKind::van ? 0.1 : 0.0));
}

/// Lets a driver swerve to the kerb and halt there at x.
void draw_up(Plan& plan, Driver& driver, double x, double time) {
    const double place = driver.way * x;
    driver.swerves.push_back({place - 16.0, place - 1.5, at_kerb(driver.kind, driver.way)});
    driver.halts.push_back({.at = place - 18.0, .gives_way = true});
    driver.halts.push_back({.at = place, .time = time, .gives_way = true});
    const double back = x - driver.way * 14.0, ahead = x + driver.way * 5.0;
    plan.free.push_back({-driver.way, std::min(back, ahead), std::max(back, ahead)});
}

/// Lets a driver swerve from the kerb back into the lane.
void pull_out(Plan& plan, Driver& driver, double x) {
    const double place = driver.way * x;
    driver.swerves.push_back({place + 0.8, place + 15.0, -driver.way * lane});
    const double back = x - driver.way * 5.0, ahead = x + driver.way * 14.0;
    plan.free.push_back({-driver.way, std::min(back, ahead), std::max(back, ahead)});
}

struct Range {
    double low, high;
};

/// A car that is parked at the start and leaves at some time within the range.
void add_leaving(Plan& plan, double way, double x, const Range& times, Random& random) {
    Driver driver = in_lane(VehicleKind::car, way, x, random);
    driver.y = at_kerb(driver.kind, way);
    driver.moving = false;
    driver.halts = {{.at = driver.start,
                     .not_before = random.uniform(times.low, times.high),
                     .gives_way = true}};
    pull_out(plan, driver, x);
    plan.drivers.push_back(driver);
}

/// A car that comes, parks and stays.
void add_parking(Plan& plan, double way, double x, double slot, Random& random) {
    Driver driver = in_lane(VehicleKind::car, way, x, random);
    draw_up(plan, driver, slot, 1e9);
    plan.drivers.push_back(driver);
}

/// The lane of the sensor, from the vehicles that wait at the third light to those behind the
/// sensor.
void add_own_lane(Plan& plan, Random& random) {
    Driver sensor = in_lane(VehicleKind::car, 1.0, -165.0 - random.uniform(0.0, 8.0), random);
    sensor.speed = 7.0;
    plan.drivers.push_back(sensor);
    add_column(plan, 1.0, 212.0, 3, random);
    add_column(plan, 1.0, 112.0, 3 + random.below(2), random);
    add_column(plan, 1.0, 14.0, 1 + random.below(3), random);
    add_parking(plan, 1.0, -45.0, random.uniform(84.0, 92.0), random);
    add_column(plan, 1.0, -62.0, 1 + random.below(3), random);
    add_column(plan, 1.0, sensor.start - 16.0, 4, random);
    add_column(plan, 1.0, sensor.start - 200.0, 5, random);
    add_leaving(plan, 1.0, random.uniform(58.0, 63.0), {6.0, 16.0}, random);
    add_leaving(plan, 1.0, random.uniform(172.0, 182.0), {70.0, 95.0}, random);
}

/// The opposite lane: a bus that brings people, a delivery van, and more cars.
void add_other_lane(Plan& plan, Random& random) {
    plan.bus_stop = random.uniform(166.0, 172.0);
    plan.free.push_back({1.0, plan.bus_stop - 12.0, plan.bus_stop + 12.0});
    Driver van = in_lane(VehicleKind::van, -1.0, 170.0, random);
    const double kerbside = random.uniform(88.0, 98.0);
    draw_up(plan, van, kerbside, random.uniform(62.0, 85.0));
    pull_out(plan, van, kerbside);
    plan.drivers.push_back(van);
    add_column(plan, -1.0, 48.0, 2, random);
    add_column(plan, -1.0, 187.0, 3, random);
    const int before = random.below(2);
    add_column(plan, -1.0, 248.0, before, random);
    Driver bus = in_lane(VehicleKind::bus, -1.0, 260.0 + 20.0 * before, random);
    bus.speed = 6.5;
    bus.halts = {{.at = -plan.bus_stop, .time = 40.0}};
    plan.drivers.push_back(bus);
    add_column(plan, -1.0, 306.0, 3, random);
    add_parking(plan, -1.0, 375.0, random.uniform(192.0, 198.0), random);
    add_column(plan, -1.0, 395.0, 4, random);
    add_column(plan, -1.0, 560.0, 5, random);
    add_leaving(plan, -1.0, random.uniform(58.0, 66.0), {48.0, 60.0}, random);
}

void add_cyclists(Plan& plan, Random& random) {
    for (const double x : {186.0, 95.0, 4.0, -2.0, -40.0, -118.0, -190.0, -260.0}) {
        plan.drivers.push_back(
            in_lane(VehicleKind::cyclist, 1.0, x + random.uniform(-3.0, 3.0), random));
    }
    for (const double x : {52.0, 110.0, 160.0, 205.0, 262.0, 330.0, 390.0, 460.0}) {
        plan.drivers.push_back(
            in_lane(VehicleKind::cyclist, -1.0, x + random.uniform(-3.0, 3.0), random));
    }
}

/// A column whose first vehicle comes to x some seconds after the beginning of the recording. It
/// stands there while the sensor comes, and creeps on a few times by one to three metres; the
/// others queue behind it.
void add_queue(Plan& plan, double x, int count, Random& random) {
    const double way = -1.0, from = x + 160.0 + random.uniform(0.0, 20.0);
    const std::size_t first = plan.drivers.size();
    add_column(plan, way, from, count, random);
    Driver& head = plan.drivers[first];
    double place = way * x, time = random.uniform(26.0, 36.0);
    for (int i = 0; i < 4; ++i) {
        head.halts.push_back({.at = place, .time = time});
        place += random.uniform(1.0, 3.0);
        time = random.uniform(4.0, 12.0);
    }
}

}  // namespace

Plan queue_plan(std::uint64_t seed) {
    Random random{hash(seed, 0x7a5)};
    Plan plan;
    plan.bus_stop = 330.0;
    plan.duration = 60.0;
    Driver sensor = in_lane(VehicleKind::car, 1.0, -165.0 - random.uniform(0.0, 8.0), random);
    sensor.speed = random.uniform(4.5, 6.0);
    plan.drivers.push_back(sensor);
    add_column(plan, 1.0, sensor.start + 120.0, 2, random);
    add_leaving(plan, 1.0, random.uniform(60.0, 70.0), {4.0, 10.0}, random);
    add_leaving(plan, 1.0, random.uniform(140.0, 150.0), {20.0, 30.0}, random);
    add_parking(plan, 1.0, sensor.start + 18.0, random.uniform(10.0, 20.0), random);
    plan.drivers.back().speed = sensor.speed + 0.8;
    add_column(plan, 1.0, sensor.start - 16.0, 2, random);
    add_queue(plan, random.uniform(-10.0, 10.0), 8 + random.below(3), random);
    add_cyclists(plan, random);
    return plan;
}

Plan jam_plan(std::uint64_t seed) {
    Random random{hash(seed, 0x7a1)};
    Plan plan;
    plan.duration = 185.0;
    add_signals(plan, random);
    add_own_lane(plan, random);
    add_other_lane(plan, random);
    add_cyclists(plan, random);
    return plan;
}

}  // namespace dynamic_filter::sim::jam
