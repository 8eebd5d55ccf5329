// SPDX-License-Identifier: MIT
/// Counts the points of people and vehicles that are found at once, after two seconds (settled),
/// and in the end, apart for those that move at that moment, those that rest and were seen to move
/// before, and those that rest and were not.
///   moved SCENE SENSOR SEED FRAMES RATE [THINGS] [noise] [odometry] [paper]
/// Simulates a scene, filters it, and prints a Markdown table with a row for each of these and one
/// for what is static; with THINGS, also a row for each of so many things that cost most points.
/// "noise" adds 3 cm and 0.2 degrees to each pose, and with "odometry" the filter finds the poses
/// itself. "paper" is the preset of that name: it judges windows instead of scans, and settles
/// none. The last rows are the intersection over union of what moves, without what rests, and the
/// number of times that a verdict on a thing was taken back: at least half of 20 or more points
/// were dynamic in a scan, and less than half in the next. A thing moves if both ends of what is
/// seen of it go on by more than 0.5 m/s, over half a second around the scan. It was seen to move
/// if it did so in an earlier scan with at least 20 points of it. Points between 1 and 60 m from
/// the sensor count.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "bench/parse_number.hpp"
#include "bench/scene_arguments.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/online.hpp"
#include "dynamic_filter/simulation.hpp"
#include "sim/thing_states.hpp"

namespace {

using namespace dynamic_filter;

constexpr float kNearest = 1.0F, kFarthest = 60.0F;  // [m]

constexpr double kSettledAfter = 2.0;  // [s]

constexpr std::array kNames{"moves", "rests, was seen to move", "rests, not yet moved", "static"};
constexpr std::array kVerdicts{"instant", "settled", "final"};

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

std::vector<Eigen::Vector3d> in_world(const sim::SimulatedScan& scan, const Pose& T_world_sensor) {
    std::vector<Eigen::Vector3d> world;
    for (const Point& p : scan.points) world.emplace_back(T_world_sensor * p.cast<double>());
    return world;
}

sim::SimulationOptions without_noise(sim::SimulationOptions options) {
    options.pose_noise_m = options.pose_noise_deg = 0.0;
    return options;
}

Simulated simulate(const sim::SimulationOptions& options, bool has_poses) {
    sim::Simulation simulation(options);
    std::optional<sim::Simulation> exact;
    if (options.pose_noise_m > 0.0) exact.emplace(without_noise(options));
    Simulated all;
    std::vector<sim::SeenThings> seen;
    std::vector<double> stamps;
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        sim::SimulatedScan s = simulation.scan(i);
        all.things.push_back(things_of(s));
        const Pose pose = exact ? exact->scan(i).T_world_sensor : s.T_world_sensor;
        seen.push_back(sim::seen_things(in_world(s, pose), all.things.back()));
        stamps.push_back(s.stamp);
        all.scans.push_back({std::move(s.points), s.T_world_sensor, s.stamp, i, has_poses, {}});
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
    std::size_t points = 0;
    std::array<std::size_t, kVerdicts.size()> dynamic{};
    [[nodiscard]] std::size_t missed() const { return points - dynamic.back(); }
    [[nodiscard]] double share(std::size_t verdict) const {
        return static_cast<double>(dynamic[verdict]) / static_cast<double>(points);
    }
};

void print(std::string_view name, const Count& count) {
    fmt::print("| {} | {} |", name, count.points);
    for (std::size_t v = 0; v < kVerdicts.size(); ++v) {
        fmt::print(" {:.2f} % |", 100.0 * count.share(v));
    }
    fmt::print("\n");
}

/// How the scans are filtered.
struct Way {
    std::string_view preset = "default";
    bool odometry = false;
};

/// Labels of all scans by each verdict; unknown where there is none.
std::array<std::vector<Labels>, kVerdicts.size()> filtered(const Simulated& all, double rate,
                                                           const Way& way) {
    std::array<std::vector<Labels>, kVerdicts.size()> labels;
    auto &instant = labels[0], &settled = labels[1], &final = labels[2];
    for (const Scan& scan : all.scans) {
        instant.emplace_back(scan.points.size(), Label::unknown);
    }
    settled = instant;
    std::vector<Scan> placed = all.scans;
    OnlineOptions options{.overload = Overload::wait, .horizon = 0.0, .max_bytes = 0};
    OnlineCallbacks callbacks;
    callbacks.instant = [&](const Verdict& v) {
        instant[v.index] = v.labels;
        if (!v.tracked) return;
        placed[v.index].T_world_sensor = v.tracked->T_world_sensor;
        placed[v.index].has_pose = true;
    };
    if (way.preset == "default") {
        options.settle_after = static_cast<std::size_t>(std::ceil(kSettledAfter * rate));
        callbacks.settled = [&](const Verdict& v) { settled[v.index] = v.labels; };
    }
    OnlineFilter filter(preset(way.preset), options, callbacks);
    for (const Scan& scan : all.scans) filter.push(scan);
    filter.finish();
    for (const Scan& scan : placed) final.push_back(filter.verdict(scan).labels);
    return labels;
}

using Counts = std::map<std::uint32_t, Count>;  // by thing

/// How often less than half of a thing is dynamic after at least half of it was.
std::size_t taken_back(const std::vector<Counts>& scans, std::size_t verdict) {
    constexpr std::size_t kFewest = 20;  // points
    std::size_t count = 0;
    for (std::size_t i = 1; i < scans.size(); ++i) {
        for (const auto& [thing, now] : scans[i]) {
            const auto before = scans[i - 1].find(thing);
            if (before == scans[i - 1].end()) continue;
            if (now.points < kFewest || before->second.points < kFewest) continue;
            if (before->second.share(verdict) >= 0.5 && now.share(verdict) < 0.5) ++count;
        }
    }
    return count;
}

void measure(const sim::SimulationOptions& options, const Way& way, std::size_t things) {
    const Simulated all = simulate(options, !way.odometry);
    const auto labels = filtered(all, options.rate_hz, way);
    std::array<Count, kNames.size()> counts;
    Count from_third;  // scan in which a thing is seen
    Counts of_things;
    std::map<std::uint32_t, int> views;
    std::vector<Counts> of_scans;
    for (std::size_t i = 0; i < all.scans.size(); ++i) {
        of_scans.emplace_back();
        for (const auto& [thing, state] : all.states[i]) ++views[thing];
        for (std::size_t k = 0; k < all.things[i].size(); ++k) {
            const float range = all.scans[i].points[k].norm();
            if (!(range > kNearest && range < kFarthest)) continue;
            const std::uint32_t thing = all.things[i][k];
            const ThingState state = thing == 0 ? ThingState::still : all.states[i].at(thing).state;
            const auto add = [&](Count& count) {
                ++count.points;
                for (std::size_t v = 0; v < kVerdicts.size(); ++v) {
                    count.dynamic[v] += labels[v][i][k] == Label::dynamic ? 1U : 0U;
                }
            };
            add(counts[row_of(state)]);
            if (thing != 0) add(of_things[thing]), add(of_scans.back()[thing]);
            if (state == ThingState::moves && views[thing] >= 3) add(from_third);
        }
    }
    fmt::print("| share called dynamic | points | {} |\n|---|---|---|---|---|\n",
               fmt::join(kVerdicts, " | "));
    for (std::size_t s = 0; s < counts.size(); ++s) print(kNames[s], counts[s]);
    print("moves, from its third scan on", from_third);
    std::vector<std::pair<std::uint32_t, Count>> worst(of_things.begin(), of_things.end());
    std::sort(worst.begin(), worst.end(),
              [](const auto& a, const auto& b) { return a.second.missed() > b.second.missed(); });
    for (std::size_t k = 0; k < std::min(things, worst.size()); ++k) {
        print(fmt::format("thing {}", worst[k].first), worst[k].second);
    }
    const auto& [moving, moved, not_yet, still] = counts;
    fmt::print("| IoU of what moves | |");
    for (std::size_t v = 0; v < kVerdicts.size(); ++v) {
        fmt::print(" {:.3f} |", static_cast<double>(moving.dynamic[v]) /
                                    static_cast<double>(moving.points + still.dynamic[v]));
    }
    fmt::print("\n| verdicts on things that were taken back | |");
    for (std::size_t v = 0; v < kVerdicts.size(); ++v) {
        fmt::print(" {} |", taken_back(of_scans, v));
    }
    fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::vector<std::string_view> words(argv + 1, argv + argc);
        if (words.size() < kSceneArguments) {
            throw ConfigError(
                "usage: moved SCENE SENSOR SEED FRAMES RATE [THINGS] [noise] [odometry] [paper]");
        }
        sim::SimulationOptions options = scene_of(words);
        Way way;
        std::size_t things = 0;
        for (const std::string_view word : std::span(words).subspan(kSceneArguments)) {
            if (word == "noise") {
                options.pose_noise_m = 0.03, options.pose_noise_deg = 0.2;
            } else if (word == "odometry") {
                way.odometry = true;
            } else if (word == "paper") {
                way.preset = word;
            } else {
                things = parse<std::size_t>("THINGS", word);
            }
        }
        measure(options, way, things);
    } catch (const Error& error) {
        fmt::print(stderr, "moved: {}\n", error.what());
        return 2;
    }
}
