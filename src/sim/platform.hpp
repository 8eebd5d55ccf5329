// SPDX-License-Identifier: MIT
/// The station of the scene `platform`: its measures, its train's timetable and its people.
#pragma once

#include <cstdint>
#include <vector>

#include "bodies.hpp"
#include "crowd.hpp"
#include "prototypes.hpp"

namespace dynamic_filter::sim::platform {

constexpr double half_length = 36.0, half_width = 4.5;  // of the platform; the track is at +y
constexpr double ceiling = 4.6, track = -1.1;           // [m]
constexpr double train_y = half_width + 0.15 + wagon_half_width;  // middle of the train
constexpr double aboard = half_width + 0.12;  // y beyond which people are on the train's floor
constexpr double wagon_pitch = 2.0 * wagon_half_length + 0.6;  // from wagon to wagon
constexpr double exit_from = half_length + 0.3, exit_until = half_length + 6.0;  // corridors
constexpr double leg = 2.0;      // |y| of the robot's way along and back
constexpr double pillars = 9.0;  // [m] between the rows of the middle

/// x of the doors of the train that stands.
std::vector<double> doors();

/// When the doors are open wide [s].
struct Timetable {
    double opens = 0.0, closes = 0.0;
};

struct Train {
    std::vector<Vehicle> wagons;
    Timetable timetable;
};

Train train(std::uint64_t seed);

/// Walkers who get off or on, wait longer than the train stays, or pass through.
std::vector<Walker> people(int count, const Timetable& timetable, std::uint64_t seed);

}  // namespace dynamic_filter::sim::platform
