// SPDX-License-Identifier: MIT
/// The street of the scenes `jam` and `queue`: its dimensions, traffic and people.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/crowd.hpp"
#include "sim/obstacles.hpp"
#include "sim/traffic.hpp"

namespace dynamic_filter::sim::jam {

// [m] middle of each lane, from the middle of the street.
constexpr double lane = 1.8, cycle_lane = 3.65;
constexpr double parking = 5.2;             // middle of the row of parked cars
constexpr double kerb = 6.5, front = 11.0;  // [m] edges of the pavement
constexpr double pavement = 0.15;           // [m] above the street
constexpr double begin = -20.0;             // [s] of the traffic

/// A part of the row of parked cars that must stay free.
struct Free {
    double side, from, until;  ///< +1 or -1, and range of x
};

struct Plan {
    std::vector<Signal> signals;
    std::vector<Driver> drivers;  ///< the first vehicle carries the sensor
    std::vector<Free> free;
    double bus_stop = 0.0;  ///< x; the bus stop is on the side of +y
    double duration = 0.0;  ///< [s]
};

/// The sensor stands in queues at lights.
Plan jam_plan(std::uint64_t seed);
/// The sensor drives by while others queue in the other lane, creep on, pull out and park.
Plan queue_plan(std::uint64_t seed);

/// Walkers who cross at the lights, wait at the bus stop, talk, or walk along the pavements.
std::vector<Walker> people(int count, const Plan& plan, const DistanceField& field,
                           std::uint64_t seed);

}  // namespace dynamic_filter::sim::jam
