// SPDX-License-Identifier: MIT
/// Measures the accuracy of verdicts that settle some seconds after their scan. Simulates a scene,
/// filters it, and prints a row of a Markdown table for each delay.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <string_view>
#include <vector>

#include "bench/parse_number.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/scores.hpp"
#include "dynamic_filter/simulation.hpp"
#include "geometry/voxel_index.hpp"

namespace {

using namespace dynamic_filter;

constexpr double kVoxel = 0.2;  // [m] voxels of the scores
// [s] in addition to instant and final verdicts.
constexpr std::array<double, 4> kDelays{0.5, 1, 2, 5};
constexpr std::size_t kMoments = kDelays.size() + 2;

sim::SimulationOptions read_arguments(const std::vector<std::string_view>& words) {
    if (words.size() != 6) {
        throw ConfigError("usage: settled SCENE SENSOR PEDESTRIANS RATE SECONDS SEED");
    }
    sim::SimulationOptions scene;
    scene.scene = words[0];
    scene.sensor = words[1];
    scene.pedestrians = parse<int>("PEDESTRIANS", words[2]);
    scene.rate_hz = parse<double>("RATE", words[3]);
    const double scans = parse<double>("SECONDS", words[4]) * scene.rate_hz;
    scene.frames = static_cast<std::size_t>(std::lround(scans));
    scene.seed = parse<std::uint64_t>("SEED", words[5]);
    return scene;
}

/// Scores of the verdicts at one delay. A voxel that holds both kinds is left out.
class Scores {
public:
    void add(const Scan& scan, const std::vector<bool>& moves, const Labels& labels) {
        for (std::size_t i = 0; i < labels.size(); ++i) {
            confusion_.add(moves[i] ? Label::dynamic : Label::static_, labels[i]);
            const Eigen::Vector3d world = scan.T_world_sensor * scan.points[i].cast<double>();
            const auto cell = cell_of(world.cast<float>(), static_cast<float>(1.0 / kVoxel));
            if (!cell) continue;
            const std::uint32_t id = voxels_.insert(pack(*cell));
            if (id == states_.size()) states_.emplace_back();
            (moves[i] ? states_[id].dynamic : states_[id].still) = true;
            states_[id].kept |= labels[i] != Label::dynamic;
        }
    }
    void print(std::string_view moment) const {
        double still = 0, kept = 0, dynamic = 0, removed = 0;
        for (const State& s : states_) {
            if (s.still == s.dynamic) continue;
            (s.still ? still : dynamic) += 1.0;
            kept += s.still && s.kept ? 1.0 : 0.0;
            removed += s.dynamic && !s.kept ? 1.0 : 0.0;
        }
        const double pr = kept / still, rr = removed / dynamic;
        fmt::print("| {} | {:.1f} | {:.1f} | {:.3f} | {:.3f} |\n", moment, 100.0 * pr, 100.0 * rr,
                   2.0 * pr * rr / (pr + rr), confusion_.iou().value_or(0.0));
    }

private:
    struct State {
        bool still = false, dynamic = false, kept = false;
    };
    VoxelIndex voxels_;
    std::vector<State> states_;
    eval::Confusion confusion_;
};

/// A scan that waits for its next delay.
struct Waiting {
    Scan scan;
    std::vector<bool> moves;
    std::size_t next = 0;  // index into kDelays
};

void ask(std::deque<Waiting>& waiting, double now, const DynamicFilter& filter,
         std::array<Scores, kMoments>& scores) {
    constexpr double kRounding = 1e-6;
    for (Waiting& w : waiting) {
        while (w.next < kDelays.size() && now + kRounding >= w.scan.stamp + kDelays[w.next]) {
            scores[++w.next].add(w.scan, w.moves, filter.settled(w.scan).labels);
        }
    }
    while (!waiting.empty() && waiting.front().next == kDelays.size()) waiting.pop_front();
}

void measure(const sim::SimulationOptions& options) {
    sim::Simulation simulation(options);
    DynamicFilter filter{Config{}};
    std::array<Scores, kMoments> scores;
    const auto pop = [&](std::size_t i) {
        const sim::SimulatedScan in = simulation.scan(i);
        Waiting w{{in.points, in.T_world_sensor, in.stamp, i}, {}};
        for (const sim::Kind kind : in.kinds) w.moves.push_back(is_dynamic(kind));
        return w;
    };
    std::deque<Waiting> waiting;
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        waiting.push_back(pop(i));
        const Waiting& newest = waiting.back();
        scores[0].add(newest.scan, newest.moves, filter.push(newest.scan).labels);
        ask(waiting, newest.scan.stamp, filter, scores);
    }
    ask(waiting, std::numeric_limits<double>::infinity(), filter, scores);
    filter.finish();
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        const Waiting w = pop(i);
        scores.back().add(w.scan, w.moves, filter.verdict(w.scan).labels);
    }
    fmt::print("| verdicts after | PR [%] | RR [%] | F1 | moving IoU |\n|---|--:|--:|--:|--:|\n");
    scores.front().print("0 s");
    for (std::size_t d = 0; d < kDelays.size(); ++d) {
        scores[d + 1].print(fmt::format("{:g} s", kDelays[d]));
    }
    scores.back().print("the end");
}

}  // namespace

int main(int argc, char** argv) {
    try {
        measure(read_arguments({argv + 1, argv + argc}));
        return 0;
    } catch (const std::exception& e) {
        fmt::print(stderr, "settled: {}\n", e.what());
        return 2;
    }
}
