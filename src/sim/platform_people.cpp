// SPDX-License-Identifier: MIT
#include <algorithm>

#include "sim/people.hpp"
#include "sim/platform.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim::platform {
namespace {

using Eigen::Vector2d;

constexpr double never = 1e9;    // [s]
constexpr double slowest = 4.0;  // [s] that a person at a door needs to get in

/// A release that holds a walker until a time.
std::function<double(double)> until(double time) {
    return [time](double t) { return std::max(t, time); };
}

/// Standing places, each used only once: people stand for minutes and would push each other.
struct Places {
    std::vector<Vector2d> taken;

    Vector2d choose(const std::function<Vector2d()>& draw, double room) {
        Vector2d p = draw();
        for (int attempt = 0; attempt < 200; ++attempt, p = draw()) {
            const bool vacant = std::none_of(taken.begin(), taken.end(), [&](const Vector2d& q) {
                return (p - q).norm() < room;
            });
            if (vacant) break;
        }
        taken.push_back(p);
        return p;
    }
};

struct Station {
    Timetable timetable;
    Random random;
    Places places;

    /// A place to stand outside the way of the robot: at the edge, at the wall, or between the
    /// pillars.
    Vector2d spot() {
        return places.choose(
            [&]() -> Vector2d {
                const int strip = random.below(3);
                const double x = random.uniform(-half_length + 8.0, half_length - 8.0);
                if (strip == 0) return {x, random.uniform(3.0, 3.7)};
                if (strip == 1) return {x, random.uniform(-3.4, -3.0)};
                const double row = pillars * static_cast<double>(random.below(6) - 3);
                return {row + random.uniform(5.6, 7.6), random.uniform(-0.9, 0.9)};
            },
            0.9);
    }
    /// Another place, at such a distance that the walker clearly moves.
    Vector2d spot_away_from(const Vector2d& p) {
        Vector2d q = spot();
        for (int attempt = 0; attempt < 20 && (p - q).norm() < 4.0; ++attempt) q = spot();
        return q;
    }
    Vector2d behind_exit(double side) {
        return places.choose(
            [&] {
                return Vector2d{side * random.uniform(exit_from + 1.5, exit_until - 0.6),
                                random.uniform(-3.6, 0.6)};
            },
            0.6);
    }
    Vector2d in_train(double door) {
        return places.choose(
            [&] {
                return Vector2d{door + random.uniform(-2.4, 2.4),
                                random.uniform(train_y - 0.8, train_y + 0.3)};
            },
            0.6);
    }
    double side() { return random.chance(0.5) ? 1.0 : -1.0; }
};

/// Adds the way through the doorway of an exit; `out` selects the direction.
void pass_exit(std::vector<Waypoint>& route, double side, bool out, Random& random) {
    const double y = random.uniform(-2.4, -1.4);
    const Waypoint before{.at = {side * (half_length - 1.2), y}, .reach = 0.7};
    const Waypoint behind{.at = {side * (exit_from + 0.9), y}, .reach = 0.7};
    route.push_back(out ? before : behind);
    route.push_back(out ? behind : before);
}

/// Adds the way along the middle of the platform, past pillars, to an exit.
void leave(Station& station, std::vector<Waypoint>& route, double from, double side) {
    const double y = station.random.uniform(-2.6, -1.4);
    for (double x = from + 6.0 * side; side * x < half_length - 4.0; x += 8.0 * side)
        route.push_back({.at = {x, y}, .reach = 1.2});
    pass_exit(route, side, true, station.random);
    route.push_back({.at = station.behind_exit(side), .release = until(never)});
}

/// Route: stands, walks to the door when it opens, and leaves with the train.
std::vector<Waypoint> getting_on(Station& station) {
    const std::vector<double> all = doors();
    const double door =
        all[static_cast<std::size_t>(station.random.below(static_cast<int>(all.size())))];
    const Vector2d spot = station.places.choose(
        [&]() -> Vector2d {
            const double side = station.side();
            return {door + side * station.random.uniform(1.1, 3.4),
                    station.random.uniform(3.0, 3.8)};
        },
        0.7);
    const Timetable times = station.timetable;
    const double first = times.opens + station.random.uniform(7.0, 14.0);
    const auto if_open = [times](double t) { return t < times.closes - slowest ? t : never; };
    return {{.at = spot, .reach = 0.4, .face = {spot.x(), 20.0}, .release = until(first)},
            {.at = {door, half_width - 0.6}, .reach = 0.45, .release = if_open},
            {.at = {door, aboard + 0.7}, .reach = 0.4},
            {.at = station.in_train(door), .reach = 0.5, .release = until(never)}};
}

/// Route: comes with the train, gets off, and leaves the platform or waits there.
std::vector<Waypoint> getting_off(Station& station) {
    const std::vector<double> all = doors();
    const double door =
        all[static_cast<std::size_t>(station.random.below(static_cast<int>(all.size())))];
    const double first = station.timetable.opens + station.random.uniform(0.5, 4.0);
    std::vector<Waypoint> route = {
        {.at = station.in_train(door), .reach = 0.4, .release = until(first)},
        {.at = {door, aboard + 0.6}, .reach = 0.5},
        {.at = {door, half_width - 0.9}, .reach = 0.5},
        {.at = {door + station.random.uniform(-0.6, 0.6), 1.9}, .reach = 0.8}};
    if (station.random.chance(0.3)) {
        route.push_back(
            {.at = station.spot(), .reach = 0.5, .pause = station.random.uniform(15.0, 60.0)});
    }
    const double side = station.side();
    route.push_back({.at = {door + 2.0 * side, 1.8 * station.side()}, .reach = 1.0});
    leave(station, route, route.back().at.x(), side);
    return route;
}

/// Route: stands for minutes, walks to another place, and stands again.
std::vector<Waypoint> staying(Station& station) {
    const Vector2d a = station.spot();
    const Vector2d b = station.spot_away_from(a);
    const double leaves = station.random.uniform(15.0, 180.0);
    return {{.at = a, .reach = 0.4, .face = {a.x(), 20.0}, .release = until(leaves)},
            {.at = b,
             .reach = 0.5,
             .pause = station.random.uniform(40.0, 120.0),
             .face = {b.x(), 20.0}}};
}

/// Route from one exit to the other, sometimes with a halt.
std::vector<Waypoint> passing(Station& station) {
    std::vector<Waypoint> route;
    for (const double way : {1.0, -1.0}) {
        pass_exit(route, -way, false, station.random);
        const double y = way * station.random.uniform(1.4, 2.6);
        for (double x = -way * (half_length - 6.0); way * x < half_length - 6.0; x += way * 8.0)
            route.push_back({.at = {x, y}, .reach = 1.2});
        if (station.random.chance(0.4)) {
            route.push_back(
                {.at = station.spot(), .reach = 0.5, .pause = station.random.uniform(5.0, 60.0)});
        }
        pass_exit(route, way, true, station.random);
        route.push_back({.at = station.behind_exit(way),
                         .reach = 0.6,
                         .pause = station.random.uniform(2.0, 25.0)});
    }
    return route;
}

/// Adds two or three people who talk, and later leave together.
void add_group(std::vector<Walker>& walkers, int size, int company, Station& station) {
    const Vector2d middle = station.places.choose(
        [&]() -> Vector2d {
            const double row = pillars * static_cast<double>(station.random.below(6) - 3);
            return {row + station.random.uniform(6.0, 7.2), station.random.uniform(-0.3, 0.3)};
        },
        2.2);
    const double leaves = station.random.uniform(20.0, 190.0);
    for (int k = 0; k < size; ++k) {
        Walker walker = draw_walker(station.random);
        walker.company = company;
        walker.luggage = station.random.chance(0.35);
        const Vector2d off = k == 0   ? Vector2d(-0.5, 0.0)
                             : k == 1 ? Vector2d(0.5, 0.1)
                                      : Vector2d(0.05, 0.55);
        const Vector2d then = station.spot_away_from(middle);
        walker.route = {
            {.at = middle + off, .reach = 0.4, .face = middle, .release = until(leaves)},
            {.at = then, .reach = 0.5, .pause = station.random.uniform(30.0, 90.0)}};
        walker.start = walker.route[0].at;
        walkers.push_back(walker);
    }
}

}  // namespace

std::vector<double> doors() {
    std::vector<double> out;
    for (const double wagon : {-wagon_pitch, 0.0, wagon_pitch})
        for (const double door : wagon_doors) out.push_back(wagon + door);
    return out;
}

std::vector<Walker> people(int count, const Timetable& timetable, std::uint64_t seed) {
    Station station{.timetable = timetable, .random = {hash(seed, 0x9a1)}, .places = {}};
    std::vector<Walker> walkers;
    int companies = 0;
    for (int turn = 0; static_cast<int>(walkers.size()) < count; ++turn) {
        const int room = count - static_cast<int>(walkers.size());
        const int kind = turn % 10;
        if (kind == 9 && room >= 2) {
            add_group(walkers, room >= 3 && station.random.chance(0.5) ? 3 : 2, companies++,
                      station);
            continue;
        }
        Walker walker = draw_walker(station.random);
        walker.luggage = station.random.chance(0.35);
        if (kind < 3) {
            // Slower people would not be in before the doors close.
            walker.speed = std::max(walker.speed, 1.0);
            walker.route = getting_on(station);
        } else if (kind < 5) {
            walker.route = getting_off(station);
        } else if (kind < 8) {
            walker.route = staying(station);
        } else {
            walker.route = passing(station);
            walker.next = static_cast<std::size_t>(
                station.random.below(static_cast<int>(walker.route.size())));
        }
        walker.start = walker.route[walker.next].at;
        walkers.push_back(walker);
    }
    return walkers;
}

}  // namespace dynamic_filter::sim::platform
