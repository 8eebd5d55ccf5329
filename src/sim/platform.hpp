// SPDX-License-Identifier: MIT
/// The station of the scene `platform`: its dimensions, timetable and people.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/bodies.hpp"
#include "sim/crowd.hpp"
#include "sim/prototypes.hpp"

namespace dynamic_filter::sim::platform {

constexpr double half_length = 36.0, half_width = 4.5;  // of the platform; the track is at +y
constexpr double ceiling = 4.6, track = -1.1;           // [m]
constexpr double train_y = half_width + 0.15 + wagon_half_width;  // middle of the train
// [m] y beyond which people are on the floor of the train.
constexpr double aboard = half_width + 0.12;
constexpr double wagon_pitch = 2.0 * wagon_half_length + 0.6;  // from wagon to wagon
constexpr double exit_from = half_length + 0.3, exit_until = half_length + 6.0;  // corridors
constexpr double leg = 2.0;      // [m] |y| of the legs of the robot's way
constexpr double pillars = 9.0;  // [m] between the pillars in the middle

/// x of the doors of the train while it stands.
std::vector<double> doors();

/// Times [s] at which the doors are fully open.
struct Timetable {
    double opens = 0.0, closes = 0.0;
};

struct Train {
    std::vector<Vehicle> wagons;
    Timetable timetable;
};

Train train(std::uint64_t seed);

/// Walkers who get off or on, wait longer than the train stays, or walk through.
std::vector<Walker> people(int count, const Timetable& timetable, std::uint64_t seed);

}  // namespace dynamic_filter::sim::platform
