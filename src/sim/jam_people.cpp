// SPDX-License-Identifier: MIT
#include "sim/jam.hpp"
#include "sim/people.hpp"
#include "sim/props.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim::jam {
namespace {

using Eigen::Vector2d;

constexpr double footway = 8.8;  // [m] |y| at which people walk

/// A place at the kerb to wait for the light; the other side is visible from it.
Waypoint kerbside(const Signal& signal, double side, Random& random) {
    const Vector2d at{signal.at + random.uniform(-1.8, 1.8),
                      side * (kerb + random.uniform(0.4, 1.7))};
    return {.at = at, .reach = 0.4, .face = {at.x(), -20.0 * side}, .release = [signal](double t) {
                return may_walk(signal, t);
            }};
}

/// Route over the street, along the other pavement, to a shop window, and back.
std::vector<Waypoint> crossing(const Signal& signal, Random& random) {
    std::vector<Waypoint> out;
    const double first = random.chance(0.5) ? 1.0 : -1.0;
    for (const double side : {first, -first}) {
        out.push_back(kerbside(signal, side, random));
        out.push_back({.at = {signal.at + random.uniform(-1.5, 1.5), -side * (kerb + 0.8)}});
        const double way = random.chance(0.5) ? 1.0 : -1.0;
        const double away = way * random.uniform(6.0, 22.0);
        out.push_back({.at = {signal.at + away, -side * random.uniform(8.2, 9.4)},
                       .pause = random.chance(0.6) ? random.uniform(5.0, 45.0) : 0.0});
    }
    return out;
}

/// Route to the bus stop, with a wait there, and on.
std::vector<Waypoint> waiting(double stop, Random& random) {
    const Vector2d at{stop + random.uniform(-4.5, 4.5), random.uniform(kerb + 0.5, kerb + 1.8)};
    const double way = random.chance(0.5) ? 1.0 : -1.0;
    return {{.at = at,
             .reach = 0.4,
             .pause = random.uniform(30.0, 90.0),
             .face = {at.x() + 6.0, -10.0}},
            {.at = {stop + way * random.uniform(10.0, 25.0), random.uniform(8.2, 9.2)}},
            {.at = {stop + way * random.uniform(26.0, 34.0), random.uniform(8.2, 9.2)},
             .pause = random.uniform(0.0, 20.0)}};
}

/// Route along a pavement to a conversation, and back.
std::vector<Waypoint> talking(Random& random) {
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    const double x = random.uniform(-25.0, 235.0);
    const Vector2d middle(x, side * random.uniform(8.6, 9.2));
    return {{.at = middle + Vector2d(-0.5, 0.0),
             .reach = 0.4,
             .pause = random.uniform(20.0, 90.0),
             .face = middle},
            {.at = {x + random.uniform(12.0, 25.0), side * footway}},
            {.at = {x + random.uniform(3.0, 6.0), side * (footway + 0.8)}}};
}

std::vector<Waypoint> strolling(Random& random) {
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    const double a = random.uniform(-40.0, 170.0), b = a + random.uniform(50.0, 80.0);
    const double y = random.uniform(8.1, 9.4), z = random.uniform(8.1, 9.4);
    std::vector<Waypoint> out;
    for (const double x : row(a, b, 8.0)) out.push_back({.at = {x, side * y}});
    for (const double x : row(a, b, 8.0)) out.push_back({.at = {a + b - x, side * z}});
    return out;
}

/// Lets the walker start at a waypoint of its route that is not on the street.
void start_at(Walker& walker, std::size_t waypoint) {
    walker.next = waypoint;
    walker.start = walker.route[waypoint].at;
}

}  // namespace

std::vector<Walker> people(int count, const Plan& plan, const DistanceField& field,
                           std::uint64_t seed) {
    Random random{hash(seed, 0x7a2)};
    std::vector<Walker> walkers, strollers;
    const auto room = [&] {
        return count - static_cast<int>(walkers.size()) - static_cast<int>(strollers.size());
    };
    int companies = 0;
    for (int turn = 0; room() > 0; ++turn) {
        Walker walker = draw_walker(random);
        if (turn % 10 < 4 && !plan.signals.empty()) {
            // Slower people would not be across before the light changes.
            walker.speed = std::max(walker.speed, 1.0);
            walker.route = crossing(
                plan.signals[static_cast<std::size_t>(turn) % plan.signals.size()], random);
            start_at(walker, static_cast<std::size_t>(random.below(2)) * 3 +
                                 static_cast<std::size_t>(random.below(2)) * 2);
            walkers.push_back(walker);
        } else if (turn % 10 < 6) {
            walker.route = waiting(plan.bus_stop, random);
            start_at(walker, static_cast<std::size_t>(random.below(3)));
            walkers.push_back(walker);
        } else if (turn % 10 == 6 && room() >= 3) {
            walker.route = talking(random);
            walker.company = companies++;
            start_at(walker, 0);
            walkers.push_back(walker);
            for (const double offset : {0.55, -0.55}) {
                if (offset < 0.0 && random.chance(0.4)) continue;
                walkers.push_back(companion(walker, offset, random));
                start_at(walkers.back(), 0);
            }
        } else {
            walker.route = strolling(random);
            strollers.push_back(walker);
        }
    }
    scatter(strollers, field, random);
    walkers.insert(walkers.end(), strollers.begin(), strollers.end());
    return walkers;
}

}  // namespace dynamic_filter::sim::jam
