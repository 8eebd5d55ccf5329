// SPDX-License-Identifier: MIT
/// A city with streets in a grid, for long drives on several days. Cars are parked, leave and come
/// between the drives, and building sites begin. The sensor is on a vehicle that drives at 8 to
/// 10 m/s, turns at crossings and halts at some.
#include <map>
#include <memory>

#include "sim/city.hpp"

namespace dynamic_filter::sim {
namespace city {
namespace {

using Eigen::Vector2d;

/// One drive through the city.
struct City {
    std::uint64_t seed = 0;
    Day day;
    Route route;
    std::vector<Actor> actors;
    /// Blocks that were near the vehicle, with all that rests there.
    std::map<std::pair<int, int>, std::vector<Fixture>> blocks;

    const std::vector<Fixture>& block(int x, int y);
    Surroundings around(double t, double reach);
};

const std::vector<Fixture>& City::block(int x, int y) {
    const auto [at, is_new] = blocks.try_emplace({x, y});
    if (is_new) {
        at->second = block_fixtures(seed, {x, y});
        const std::vector<Fixture> cars = parked(seed, {x, y}, day);
        at->second.insert(at->second.end(), cars.begin(), cars.end());
    }
    return at->second;
}

/// Numbers of the people and vehicles that move go round: there are more than numbers.
std::uint16_t number(std::size_t actor) { return static_cast<std::uint16_t>(actor % 65535 + 1); }

std::vector<Part> parts_of(const Actor& actor, std::size_t index) {
    std::vector<Part> parts = actor.on_foot ? walker_parts(index) : vehicle_parts(actor.vehicle);
    for (Part& part : parts) part.instance = number(index);
    return parts;
}

void place(const Actor& actor, double t, Placements& out) {
    if (!actor.on_foot) return place_vehicle(actor.vehicle, t, out);
    const Stride stride = stride_of(actor, t);
    place_walker(actor.walker, stride, ground(stride.position.cast<double>()), out);
}

Surroundings City::around(double t, double reach) {
    constexpr double largest = 25.0;  // [m] of houses
    const Vector2d p = at(route.ride.path, travelled(route.ride, t)).position;
    const auto first = [&](int axis) {
        return static_cast<int>(std::floor((p[axis] - reach) / pitch[axis]));
    };
    const auto last = [&](int axis) {
        return static_cast<int>(std::floor((p[axis] + reach) / pitch[axis]));
    };
    Surroundings out;
    Placements still;
    for (int x = first(0); x <= last(0); ++x) {
        for (int y = first(1); y <= last(1); ++y) {
            for (const Fixture& fixture : block(x, y)) {
                const Vector2d at =
                    fixture.placement.T_world_part.translation().head<2>().cast<double>();
                if (fixture.part.prototype != slab && (at - p).norm() > reach + largest) continue;
                out.parts.push_back(fixture.part);
                still.push_back(fixture.placement);
            }
        }
    }
    std::vector<std::size_t> moving;
    for (std::size_t i = 0; i < actors.size(); ++i) {
        if (t < actors[i].from || t > actors[i].until) continue;
        moving.push_back(i);
        const std::vector<Part> parts = parts_of(actors[i], i);
        out.parts.insert(out.parts.end(), parts.begin(), parts.end());
    }
    out.placements = [this, still, moving](double time) {
        Placements all = still;
        for (const std::size_t i : moving) place(actors[i], time, all);
        return all;
    };
    return out;
}

}  // namespace
}  // namespace city

Scene city_scene(int pedestrians, std::uint64_t seed, const Trip& trip) {
    using namespace city;
    auto made = std::make_shared<City>();
    made->seed = seed;
    made->day = {trip.drive, trip.drives};
    made->route = route(seed, trip.km, trip.drive);
    made->actors = actors(seed, made->route, pedestrians, trip.drive);
    Scene scene;
    scene.prototypes = library(seed);
    scene.robot = made->route.ride;
    scene.robot_radius = 1.2;
    scene.sensor_height = 1.83;
    scene.duration = made->route.duration;
    scene.floor = 0.05;
    scene.ground = ground;
    scene.around = [made](double t, double reach) { return made->around(t, reach); };
    return scene;
}

Scene city_scene(int pedestrians, std::uint64_t seed) {
    return city_scene(pedestrians, seed, Trip{});
}

}  // namespace dynamic_filter::sim
