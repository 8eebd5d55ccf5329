// SPDX-License-Identifier: MIT
#include "sim/thing_states.hpp"

#include <algorithm>

namespace dynamic_filter::sim {

namespace {

constexpr std::size_t kSeen = 20;  // points
constexpr double kAround = 0.25;   // [s] before and after a scan

bool goes_on(const SeenThing& from, const SeenThing& to, double seconds) {
    constexpr double kSlow = 0.5;  // [m/s]
    const Eigen::Array2d low = (to.box.min() - from.box.min()).array() / seconds;
    const Eigen::Array2d high = (to.box.max() - from.box.max()).array() / seconds;
    const auto both = low.abs().min(high.abs()) > kSlow && low * high > 0.0;
    return both.any();
}

/// The scans between which the motion at scan i is measured.
struct Around {
    std::size_t first, last;
};

Around around(std::size_t i, std::span<const double> stamps) {
    Around scans{i, i};
    while (scans.first > 0 && stamps[i] - stamps[scans.first] < kAround) --scans.first;
    while (scans.last + 1 < stamps.size() && stamps[scans.last] - stamps[i] < kAround) {
        ++scans.last;
    }
    return scans;
}

bool moves(std::uint32_t thing, const SeenThings& from, const SeenThings& to, double seconds) {
    const auto a = from.find(thing), b = to.find(thing);
    return a != from.end() && b != to.end() && goes_on(a->second, b->second, seconds);
}

}  // namespace

SeenThings seen_things(std::span<const Eigen::Vector3d> world,
                       std::span<const std::uint32_t> things) {
    SeenThings seen;
    for (std::size_t i = 0; i < things.size(); ++i) {
        if (things[i] == 0) continue;
        SeenThing& thing = seen[things[i]];
        thing.box.extend(world[i].head<2>());
        ++thing.points;
    }
    return seen;
}

std::vector<StatesOfThings> states_of(std::span<const SeenThings> scans,
                                      std::span<const double> stamps) {
    std::vector<StatesOfThings> states(scans.size());
    std::map<std::uint32_t, bool> was_seen;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const auto [first, last] = around(i, stamps);
        for (const auto& [thing, seen] : scans[i]) {
            const bool is_moving =
                moves(thing, scans[first], scans[last], stamps[last] - stamps[first]);
            states[i][thing].state = is_moving         ? ThingState::moves
                                     : was_seen[thing] ? ThingState::moved
                                                       : ThingState::never;
            if (is_moving && seen.points >= kSeen) was_seen[thing] = true;
        }
    }
    for (StatesOfThings& of_scan : states) {
        for (auto& [thing, state] : of_scan) {
            state.is_seen_moving = was_seen[thing];
            const bool will = state.is_seen_moving && state.state == ThingState::never;
            if (will) state.state = ThingState::will_move;
        }
    }
    return states;
}

}  // namespace dynamic_filter::sim
