// SPDX-License-Identifier: MIT
/// How well `convert --to objects` tells objects apart and follows them, by the exact objects of a
/// simulated scene. The filter runs first; its labels say what moves. Prints a row of a table: true
/// objects that labels show in at least three scans, those that one number holds for at least half
/// of their points; the share of an object's points that its most frequent number has, and the
/// share of a number's points that its most frequent object has, over all points [%]; how often an
/// object changes its number; and the objects of the output.
#include <fmt/format.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "bench/scene_arguments.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/simulation.hpp"
#include "objects/object_tracker.hpp"

namespace {

using namespace dynamic_filter;

struct SeenObject {
    std::map<std::uint32_t, std::size_t> numbers;  // points with each number of the output
    std::size_t points = 0, scans = 0, changes = 0;
    std::uint32_t last = app::kNoObject;
};

std::uint32_t most_frequent(const std::map<std::uint32_t, std::size_t>& counts) {
    std::uint32_t best = app::kNoObject;
    std::size_t most = 0;
    for (const auto& [number, count] : counts) {
        if (count > most) best = number, most = count;
    }
    return best;
}

struct Sums {
    std::map<std::uint16_t, SeenObject> objects;                            // by the true number
    std::map<std::uint32_t, std::map<std::uint32_t, std::size_t>> numbers;  // true ones in each
    app::ObjectTracker tracker;
};

void add(Sums& sums, const sim::SimulatedScan& scan, const Labels& labels, std::size_t index) {
    std::vector<Eigen::Vector3d> places;
    std::vector<std::uint16_t> truth;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] != Label::dynamic) continue;
        places.emplace_back(scan.T_world_sensor * scan.points[i].cast<double>());
        truth.push_back(scan.instances[i]);
    }
    const std::vector<std::uint32_t> numbers = sums.tracker.follow(places, index, scan.stamp);
    std::map<std::uint16_t, std::map<std::uint32_t, std::size_t>> here;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        if (truth[i] != 0) ++here[truth[i]][numbers[i]];
        if (numbers[i] != app::kNoObject) ++sums.numbers[numbers[i]][truth[i]];
    }
    for (const auto& [object, counts] : here) {
        SeenObject& seen = sums.objects[object];
        ++seen.scans;
        for (const auto& [number, count] : counts) {
            seen.points += count;
            seen.numbers[number] += count;
        }
        const std::uint32_t now = most_frequent(counts);
        if (now == app::kNoObject) continue;
        seen.changes += seen.last != app::kNoObject && seen.last != now ? 1U : 0U;
        seen.last = now;
    }
}

void print(const sim::SimulationOptions& options, const Sums& sums) {
    std::size_t count = 0, held = 0, own = 0, points = 0, changes = 0, pure = 0, numbered = 0;
    for (const auto& [object, seen] : sums.objects) {
        if (seen.scans < 3 || seen.points < 20) continue;
        const std::size_t most = seen.numbers.at(most_frequent(seen.numbers));
        ++count;
        held += 2 * most >= seen.points && most_frequent(seen.numbers) != app::kNoObject ? 1U : 0U;
        own += most_frequent(seen.numbers) != app::kNoObject ? most : 0U;
        points += seen.points;
        changes += seen.changes;
    }
    for (const auto& [number, counts] : sums.numbers) {
        for (const auto& [object, n] : counts) numbered += n;
        pure += counts.at(most_frequent(counts));
    }
    std::size_t sure = 0;
    for (const app::MovingObject& object : sums.tracker.objects()) sure += object.is_sure();
    const auto share = [](std::size_t part, std::size_t all) {
        return 100.0 * static_cast<double>(part) / static_cast<double>(all);
    };
    fmt::print("| {} {} {} | {} | {} | {:.1f} | {:.1f} | {:.2f} | {} |\n", options.scene,
               options.sensor, options.seed, count, held, share(own, points), share(pure, numbered),
               static_cast<double>(changes) / static_cast<double>(count), sure);
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string_view> words(argv + 1, argv + argc);
    if (words.size() != kSceneArguments) {
        fmt::print(stderr, "usage: objects SCENE SENSOR SEED FRAMES RATE\n");
        return 2;
    }
    try {
        const sim::SimulationOptions options = scene_of(words);
        sim::Simulation simulation(options);
        DynamicFilter filter(preset("default"));
        std::vector<sim::SimulatedScan> scans;
        const auto scan_of = [&](std::size_t i) {
            const sim::SimulatedScan& s = scans[i];
            return Scan{s.points, s.T_world_sensor, s.stamp, i, true, {}};
        };
        for (std::size_t i = 0; i < simulation.size(); ++i) {
            scans.push_back(simulation.scan(i));
            filter.push(scan_of(i));
        }
        filter.finish();
        Sums sums;
        for (std::size_t i = 0; i < scans.size(); ++i) {
            add(sums, scans[i], filter.verdict(scan_of(i)).labels, i);
        }
        print(options, sums);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "objects: {}\n", error.what());
        return 1;
    }
}
