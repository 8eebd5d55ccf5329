// SPDX-License-Identifier: MIT
/// Scores the local static map at each moment: what a planner sees.
///   local_map SCENE SENSOR SEED FRAMES RATE [RADIUS]
/// Simulates a scene, filters it, and compares the static map around the sensor, within RADIUS (30)
/// [m], with the truth of that moment. It prints a Markdown table with a row for each two seconds,
/// and the means. Of the voxels that were seen so far,
/// - those with static points only should be in the map (PR: the share that is);
/// - those that people or vehicles have left should not (RR: the share that is not);
/// - those where people or vehicles rest, or stand in this scan, should not either (column "there
///   now": the share that is not). A planner knows them from the scan.
#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "bench/parse_number.hpp"
#include "bench/scene_arguments.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/simulation.hpp"
#include "geometry/voxel_index.hpp"

namespace {

using namespace dynamic_filter;

constexpr double kEvery = 1.0, kRow = 2.0;  // [s]

/// What was seen in a voxel so far.
struct Truth {
    bool is_static = false;
    std::size_t last_dynamic = 0;  // number of the last scan with dynamic points, from 1
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
};

struct Share {
    std::size_t right = 0, all = 0;
    void add(bool is_right) { ++all, right += is_right ? 1U : 0U; }
    [[nodiscard]] double value() const {
        return all == 0 ? 1.0 : static_cast<double>(right) / static_cast<double>(all);
    }
};

struct Scores {
    Share kept, left, there_now;
    void print(std::string_view when) const {
        const double pr = kept.value(), rr = left.value();
        fmt::print("| {} | {:.2f} | {:.2f} | {:.3f} | {:.2f} |\n", when, 100.0 * pr, 100.0 * rr,
                   2.0 * pr * rr / (pr + rr), 100.0 * there_now.value());
    }
};

void add(std::vector<Truth>& truth, const sim::SimulatedScan& s, const Pose& T_world_sensor,
         const std::vector<std::uint32_t>& voxels, std::size_t number) {
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (voxels[i] == kNoVoxel) continue;
        if (voxels[i] >= truth.size()) truth.resize(voxels[i] + 1);
        Truth& t = truth[voxels[i]];
        t.place = T_world_sensor * s.points[i].cast<double>();
        if (is_dynamic(s.kinds[i])) {
            t.last_dynamic = number;
        } else {
            t.is_static = true;
        }
    }
}

Scores compare(const std::vector<Truth>& truth, const std::vector<bool>& in_map,
               const Pose& T_world_sensor, double radius, std::size_t number) {
    Scores scores;
    for (std::size_t v = 0; v < truth.size(); ++v) {
        const Truth& t = truth[v];
        const bool is_dynamic = t.last_dynamic > 0;
        if (t.is_static == is_dynamic) continue;  // not seen, or both
        if ((t.place - T_world_sensor.translation()).norm() > radius) continue;
        const bool kept = v < in_map.size() && in_map[v];
        if (t.is_static) scores.kept.add(kept);
        if (is_dynamic) (t.last_dynamic == number ? scores.there_now : scores.left).add(!kept);
    }
    return scores;
}

void measure(const sim::SimulationOptions& options, double radius) {
    sim::Simulation simulation(options);
    DynamicFilter filter(preset("default"));
    std::vector<Truth> truth;
    Scores sum, row;
    const auto more = [](Share& to, const Share& from) {
        to.right += from.right, to.all += from.all;
    };
    fmt::print("| s | PR [%] | RR [%] | F1 | there now [%] |\n|---|---|---|---|---|\n");
    double due = kEvery, row_due = kRow;
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        const sim::SimulatedScan s = simulation.scan(i);
        const Scan scan{s.points, s.T_world_sensor, s.stamp, i, true, {}};
        filter.push(scan);
        add(truth, s, scan.T_world_sensor, filter.voxels_of(scan), i + 1);
        if (s.stamp < due) continue;
        due += kEvery;
        std::vector<bool> in_map(filter.size());
        for (const StaticVoxel& v : filter.local_static_map(scan.T_world_sensor, radius + 1.0)) {
            in_map[v.voxel] = true;
        }
        const Scores now = compare(truth, in_map, scan.T_world_sensor, radius, i + 1);
        for (Scores* to : {&sum, &row}) {
            more(to->kept, now.kept), more(to->left, now.left);
            more(to->there_now, now.there_now);
        }
        if (s.stamp < row_due) continue;
        row.print(fmt::format("{:.0f}", row_due));
        row = {};
        row_due += kRow;
    }
    sum.print("all");
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::vector<std::string_view> words(argv + 1, argv + argc);
        if (words.size() < kSceneArguments || words.size() > kSceneArguments + 1) {
            throw ConfigError("usage: local_map SCENE SENSOR SEED FRAMES RATE [RADIUS]");
        }
        measure(scene_of(words), words.size() > kSceneArguments
                                     ? parse<double>("RADIUS", words[kSceneArguments])
                                     : 30.0);
    } catch (const Error& error) {
        fmt::print(stderr, "local_map: {}\n", error.what());
        return 2;
    }
}
