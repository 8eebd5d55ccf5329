// SPDX-License-Identifier: MIT
/// Counts the points of people and vehicles that are found, apart for those that move at that
/// moment, those that rest and were seen to move before, and those that rest and were not.
///   moved SCENE SENSOR SEED FRAMES RATE [THINGS]
/// Simulates a scene, filters it, and prints a Markdown table with a row for each of these and one
/// for what is static; with THINGS, also a row for each of so many things that cost most points.
/// A thing moves if both ends of what is seen of it go on by more than 0.5 m/s, over half a second
/// around the scan. It was seen to move if it did so in an earlier scan with at least 20 points of
/// it. Points between 1 and 60 m from the sensor count.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <vector>

#include "bench/parse_number.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/simulation.hpp"

namespace {

using namespace dynamic_filter;

constexpr float kNearest = 1.0F, kFarthest = 60.0F;  // [m]
constexpr std::size_t kSeen = 20;                    // points

enum class State { moves, rests_after, rests_before, still };
constexpr std::array kNames{"moves", "rests, was seen to move", "rests, not yet moved", "static"};

struct Simulated {
    std::vector<Scan> scans;
    std::vector<std::vector<std::uint16_t>> things;  // numbers of things by point; 0: static
};

Simulated simulate(const sim::SimulationOptions& options) {
    sim::Simulation simulation(options);
    Simulated all;
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        sim::SimulatedScan s = simulation.scan(i);
        for (std::size_t k = 0; k < s.instances.size(); ++k) {
            if (!is_dynamic(s.kinds[k])) s.instances[k] = 0;
        }
        all.scans.push_back({std::move(s.points), s.T_world_sensor, s.stamp, i, true, {}});
        all.things.push_back(std::move(s.instances));
    }
    return all;
}

/// What is seen of a thing in a scan, from above.
struct Extent {
    Eigen::AlignedBox2d box;
    std::size_t points = 0;
};
using Extents = std::map<std::uint16_t, Extent>;

Extents extents_of(const Scan& scan, const std::vector<std::uint16_t>& things) {
    Extents extents;
    for (std::size_t i = 0; i < things.size(); ++i) {
        if (things[i] == 0 || scan.points[i].norm() > kFarthest) continue;
        const Eigen::Vector3d world = scan.T_world_sensor * scan.points[i].cast<double>();
        Extent& e = extents[things[i]];
        e.box.extend(world.head<2>());
        ++e.points;
    }
    return extents;
}

bool goes_on(const Extent& from, const Extent& to, double seconds) {
    constexpr double kSlow = 0.5;  // [m/s]
    const Eigen::Array2d low = (to.box.min() - from.box.min()).array() / seconds;
    const Eigen::Array2d high = (to.box.max() - from.box.max()).array() / seconds;
    const auto both = low.abs().min(high.abs()) > kSlow && low * high > 0.0;
    return both.any();
}

/// State of each thing in each scan.
std::vector<std::map<std::uint16_t, State>> states_of(const Simulated& all) {
    constexpr double kAround = 0.25;  // [s]
    std::vector<Extents> extents;
    for (std::size_t i = 0; i < all.scans.size(); ++i) {
        extents.push_back(extents_of(all.scans[i], all.things[i]));
    }
    std::map<std::uint16_t, bool> was_seen;
    std::vector<std::map<std::uint16_t, State>> states(all.scans.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
        std::size_t a = i, b = i;
        while (a > 0 && all.scans[i].stamp - all.scans[a].stamp < kAround) --a;
        while (b + 1 < states.size() && all.scans[b].stamp - all.scans[i].stamp < kAround) ++b;
        for (const auto& [thing, extent] : extents[i]) {
            const auto from = extents[a].find(thing), to = extents[b].find(thing);
            const bool moves =
                from != extents[a].end() && to != extents[b].end() &&
                goes_on(from->second, to->second, all.scans[b].stamp - all.scans[a].stamp);
            states[i][thing] = moves             ? State::moves
                               : was_seen[thing] ? State::rests_after
                                                 : State::rests_before;
            if (moves && extent.points >= kSeen) was_seen[thing] = true;
        }
    }
    return states;
}

struct Count {
    std::size_t points = 0, instant = 0, final = 0;
    [[nodiscard]] std::size_t missed() const { return points - final; }
};

void print(std::string_view name, const Count& count) {
    const auto share = [&](std::size_t n) {
        return 100.0 * static_cast<double>(n) / static_cast<double>(count.points);
    };
    fmt::print("| {} | {} | {:.1f} % | {:.1f} % |\n", name, count.points, share(count.instant),
               share(count.final));
}

void measure(const Simulated& all, std::size_t things) {
    DynamicFilter filter(preset("default"));
    std::vector<Labels> instant;
    for (const Scan& scan : all.scans) instant.push_back(filter.push(scan).labels);
    filter.finish();
    const auto states = states_of(all);
    std::array<Count, kNames.size()> counts;
    std::map<std::uint16_t, Count> of_things;
    for (std::size_t i = 0; i < all.scans.size(); ++i) {
        const Labels final = filter.verdict(all.scans[i]).labels;
        for (std::size_t k = 0; k < final.size(); ++k) {
            const float range = all.scans[i].points[k].norm();
            if (!(range > kNearest && range < kFarthest)) continue;
            const std::uint16_t thing = all.things[i][k];
            const State state = thing == 0 ? State::still : states[i].at(thing);
            const auto add = [&](Count& count) {
                ++count.points;
                count.instant += instant[i][k] == Label::dynamic ? 1U : 0U;
                count.final += final[k] == Label::dynamic ? 1U : 0U;
            };
            add(counts[static_cast<std::size_t>(state)]);
            if (thing != 0) add(of_things[thing]);
        }
    }
    fmt::print("| share called dynamic | points | instant | final |\n|---|---|---|---|\n");
    for (std::size_t s = 0; s < counts.size(); ++s) print(kNames[s], counts[s]);
    std::vector<std::pair<std::uint16_t, Count>> worst(of_things.begin(), of_things.end());
    std::sort(worst.begin(), worst.end(),
              [](const auto& a, const auto& b) { return a.second.missed() > b.second.missed(); });
    for (std::size_t k = 0; k < std::min(things, worst.size()); ++k) {
        print(fmt::format("thing {}", worst[k].first), worst[k].second);
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::vector<std::string_view> words(argv + 1, argv + argc);
        if (words.size() < 5 || words.size() > 6) {
            throw ConfigError("usage: moved SCENE SENSOR SEED FRAMES RATE [THINGS]");
        }
        sim::SimulationOptions options;
        options.scene = words[0];
        options.sensor = words[1];
        options.seed = parse<std::uint64_t>("SEED", words[2]);
        options.frames = parse<std::size_t>("FRAMES", words[3]);
        options.rate_hz = parse<double>("RATE", words[4]);
        measure(simulate(options), words.size() > 5 ? parse<std::size_t>("THINGS", words[5]) : 0);
    } catch (const Error& error) {
        fmt::print(stderr, "moved: {}\n", error.what());
        return 2;
    }
}
