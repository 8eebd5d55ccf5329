// SPDX-License-Identifier: MIT
#include "sim/scene.hpp"

namespace dynamic_filter::sim {

Scene crowd_scene(int pedestrians, std::uint64_t seed);
Scene street_scene(int pedestrians, std::uint64_t seed);
Scene square_scene(int pedestrians, std::uint64_t seed);
Scene hall_scene(int pedestrians, std::uint64_t seed);
Scene jam_scene(int pedestrians, std::uint64_t seed);
Scene queue_scene(int pedestrians, std::uint64_t seed);
Scene platform_scene(int pedestrians, std::uint64_t seed);
Scene slow_scene(int pedestrians, std::uint64_t seed);
Scene mirrors_scene(int pedestrians, std::uint64_t seed);
Scene city_scene(int pedestrians, std::uint64_t seed);
Scene city_scene(int pedestrians, std::uint64_t seed, const Trip& trip);

const std::vector<SceneEntry>& scene_table() {
    static const std::vector<SceneEntry> table = {
        {.name = "crowd", .pedestrians = 100, .rate_hz = 1.25, .rounds = 2, .make = crowd_scene},
        {.name = "street", .pedestrians = 30, .rate_hz = 10.0, .make = street_scene},
        {.name = "square", .pedestrians = 60, .rate_hz = 10.0, .make = square_scene},
        {.name = "hall", .pedestrians = 60, .rate_hz = 10.0, .make = hall_scene},
        {.name = "jam", .pedestrians = 60, .rate_hz = 10.0, .make = jam_scene},
        {.name = "queue", .pedestrians = 30, .rate_hz = 10.0, .make = queue_scene},
        {.name = "platform", .pedestrians = 80, .rate_hz = 10.0, .make = platform_scene},
        {.name = "slow", .pedestrians = 20, .rate_hz = 10.0, .make = slow_scene},
        {.name = "mirrors", .pedestrians = 25, .rate_hz = 10.0, .make = mirrors_scene},
        {.name = "city",
         .pedestrians = 14,
         .rate_hz = 10.0,
         .make = [](int pedestrians, std::uint64_t seed) { return city_scene(pedestrians, seed); },
         .make_trip = [](int pedestrians, std::uint64_t seed,
                         const Trip& trip) { return city_scene(pedestrians, seed, trip); }},
    };
    return table;
}

}  // namespace dynamic_filter::sim
