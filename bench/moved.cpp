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

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <vector>

#include "bench/parse_number.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/simulation.hpp"
#include "sim/thing_states.hpp"

namespace {

using namespace dynamic_filter;

constexpr float kNearest = 1.0F, kFarthest = 60.0F;  // [m]

constexpr std::array kNames{"moves", "rests, was seen to move", "rests, not yet moved", "static"};

struct Simulated {
    std::vector<Scan> scans;
    std::vector<std::vector<std::uint32_t>> things;  // of points; 0: static, or too far away
    std::vector<sim::StatesOfThings> states;
};

std::vector<std::uint32_t> things_of(const sim::SimulatedScan& scan) {
    std::vector<std::uint32_t> things(scan.points.size());
    for (std::size_t i = 0; i < things.size(); ++i) {
        if (scan.points[i].norm() > kFarthest) continue;
        things[i] = sim::thing_of(scan.kinds[i], scan.instances[i]);
    }
    return things;
}

std::vector<Eigen::Vector3d> in_world(const sim::SimulatedScan& scan) {
    std::vector<Eigen::Vector3d> world;
    for (const Point& p : scan.points) world.emplace_back(scan.T_world_sensor * p.cast<double>());
    return world;
}

Simulated simulate(const sim::SimulationOptions& options) {
    sim::Simulation simulation(options);
    Simulated all;
    std::vector<sim::SeenThings> seen;
    std::vector<double> stamps;
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        sim::SimulatedScan s = simulation.scan(i);
        all.things.push_back(things_of(s));
        seen.push_back(sim::seen_things(in_world(s), all.things.back()));
        stamps.push_back(s.stamp);
        all.scans.push_back({std::move(s.points), s.T_world_sensor, s.stamp, i, true, {}});
    }
    all.states = sim::states_of(seen, stamps);
    return all;
}

/// The row of the table.
std::size_t row_of(ThingState state) {
    if (state == ThingState::moves) return 0;
    if (state == ThingState::moved) return 1;
    return state == ThingState::still ? 3 : 2;
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
    std::array<Count, kNames.size()> counts;
    std::map<std::uint32_t, Count> of_things;
    for (std::size_t i = 0; i < all.scans.size(); ++i) {
        const Labels final = filter.verdict(all.scans[i]).labels;
        for (std::size_t k = 0; k < final.size(); ++k) {
            const float range = all.scans[i].points[k].norm();
            if (!(range > kNearest && range < kFarthest)) continue;
            const std::uint32_t thing = all.things[i][k];
            const ThingState state = thing == 0 ? ThingState::still : all.states[i].at(thing).state;
            const auto add = [&](Count& count) {
                ++count.points;
                count.instant += instant[i][k] == Label::dynamic ? 1U : 0U;
                count.final += final[k] == Label::dynamic ? 1U : 0U;
            };
            add(counts[row_of(state)]);
            if (thing != 0) add(of_things[thing]);
        }
    }
    fmt::print("| share called dynamic | points | instant | final |\n|---|---|---|---|\n");
    for (std::size_t s = 0; s < counts.size(); ++s) print(kNames[s], counts[s]);
    std::vector<std::pair<std::uint32_t, Count>> worst(of_things.begin(), of_things.end());
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
