// SPDX-License-Identifier: MIT
// How well both methods do on small simulated scenes: a change of the code must not make them worse
// unnoticed. Each floor is 0.005 below what was measured when it was set; raise it when the method
// gets better.
#include <gtest/gtest.h>

#include <iostream>
#include <string>

#include "dynamic_filter/online.hpp"
#include "dynamic_filter/scores.hpp"
#include "dynamic_filter/simulation.hpp"

namespace dynamic_filter {
namespace floors_test {

struct Case {
    std::string scene, sensor;
    std::size_t frames;
    double rate;  // [Hz]; 0: the scene's own
    std::string preset;
    double f1, aa;  // floors
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.scene << ", preset " << c.preset; }

eval::Scores scores_of(const Case& c) {
    sim::SimulationOptions options;
    options.scene = c.scene;
    options.sensor = c.sensor;
    options.frames = c.frames;
    options.rate_hz = c.rate;
    options.seed = 7;
    sim::Simulation simulation(options);
    OnlineFilter filter(preset(c.preset),
                        {.overload = Overload::wait, .horizon = 0.0, .max_bytes = 0});
    const auto scan_of = [&](std::size_t i) {
        const sim::SimulatedScan s = simulation.scan(i);
        return Scan{s.points, s.T_world_sensor, s.stamp, i};
    };
    for (std::size_t i = 0; i < simulation.size(); ++i) filter.push(scan_of(i));
    filter.finish();
    std::vector<eval::LabelledScan> judged;
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        sim::SimulatedScan s = simulation.scan(i);
        const Labels verdict = filter.verdict(scan_of(i)).labels;
        for (Point& p : s.points) p = (s.T_world_sensor * p.cast<double>()).cast<float>();
        judged.push_back({std::move(s.points), std::move(s.labels), verdict});
    }
    return eval::score_labels(
        judged.size(), [&](std::size_t i) { return std::optional(judged[i]); }, eval::kVoxelSize);
}

class Floor : public ::testing::TestWithParam<Case> {};

TEST_P(Floor, IsHeld) {
    const Case& c = GetParam();
    const eval::Scores scores = scores_of(c);
    const double f1 = scores.voxel.at("excluded").f1.value(), aa = scores.point.aa.value();
    RecordProperty("f1", std::to_string(f1));
    RecordProperty("aa", std::to_string(aa));
    std::cerr << c.scene << ", preset " << c.preset << ": F1 " << f1 << ", AA " << aa << '\n';
    EXPECT_GE(f1, c.f1);
    EXPECT_GE(aa, c.aa);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Floor,
    ::testing::Values(Case{"crowd", "vlp16", 120, 0.0, "default", 0.989, 0.988},
                      Case{"crowd", "vlp16", 120, 0.0, "paper", 0.941, 0.957},
                      Case{"street", "hdl32", 60, 0.0, "default", 0.959, 0.981},
                      Case{"street", "hdl32", 60, 0.0, "paper", 0.899, 0.890},
                      Case{"hall", "vlp16", 100, 0.0, "default", 0.944, 0.977},
                      Case{"hall", "vlp16", 100, 0.0, "paper", 0.923, 0.958},
                      Case{"square", "hdl32", 60, 0.0, "default", 0.943, 0.923},
                      Case{"square", "hdl32", 60, 0.0, "paper", 0.914, 0.866},
                      Case{"jam", "vlp16", 360, 2.0, "default", 0.959, 0.902},
                      Case{"platform", "vlp16", 420, 2.0, "default", 0.985, 0.915},
                      Case{"mirrors", "vlp16", 96, 2.0, "default", 0.852, 0.846}),
    [](const auto& test) { return test.param.scene + "_" + test.param.preset; });

}  // namespace floors_test
}  // namespace dynamic_filter
