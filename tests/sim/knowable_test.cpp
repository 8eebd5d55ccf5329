// SPDX-License-Identifier: MIT
#include "sim/knowable.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::sim {
namespace knowable_test {

SimulationOptions few_scans() {
    SimulationOptions options;
    options.pedestrians = 10;
    options.frames = 6;
    options.rate_hz = 5.0;
    return options;
}

std::vector<std::vector<KnowablePoint>> knowable(const SimulationOptions& options) {
    Simulation simulation(options);
    Knowable knowable;
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        const SimulatedScan scan = simulation.scan(i);
        knowable.note(scan, exact_beams(simulation, scan));
    }
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        knowable.look(exact_beams(simulation, simulation.scan(i)));
    }
    knowable.decide();
    std::vector<std::vector<KnowablePoint>> scans;
    for (std::size_t i = 0; i < simulation.size(); ++i) scans.push_back(knowable.of_scan(i));
    return scans;
}

TEST(Knowable, DynamicPointsHaveAStateAndStaticOnesHaveNone) {
    Simulation simulation(few_scans());
    const auto scans = knowable(few_scans());
    std::map<ThingState, std::size_t> states;
    std::size_t passed = 0;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const Labels labels = simulation.scan(i).labels;
        ASSERT_EQ(scans[i].size(), labels.size());
        for (std::size_t k = 0; k < labels.size(); ++k) {
            EXPECT_EQ(scans[i][k].state != ThingState::still, labels[k] == Label::dynamic);
            if (labels[k] == Label::static_) {
                EXPECT_EQ(scans[i][k], KnowablePoint{});
            }
            ++states[scans[i][k].state];
            passed += scans[i][k].beams > 0 ? 1U : 0U;
        }
    }
    EXPECT_GT(states[ThingState::moves], 100U);
    EXPECT_GT(passed, 100U);
}

TEST(Knowable, TheSameWithAnyNumberOfThreads) {
    std::vector<std::vector<KnowablePoint>> one, four;
    with_threads(1, [&] { one = knowable(few_scans()); });
    with_threads(4, [&] { four = knowable(few_scans()); });
    EXPECT_EQ(one, four);
}

TEST(Knowable, NoiseOfThePosesChangesNothing) {
    SimulationOptions noisy = few_scans();
    noisy.pose_noise_m = 0.5;
    noisy.pose_noise_deg = 5.0;
    EXPECT_EQ(knowable(noisy), knowable(few_scans()));
}

/// [m] of the returns of the ground in the world.
double mean_height(const std::vector<Beam>& beams, const SimulatedScan& scan) {
    double sum = 0.0;
    std::size_t points = 0;
    for (std::size_t i = 0; i < beams.size(); ++i) {
        if (scan.kinds[i] != Kind::ground) continue;
        sum += beams[i].end.z();
        ++points;
    }
    return sum / static_cast<double>(points);
}

TEST(Knowable, BeamsOfASweepBeginWhereTheSensorWas) {
    SimulationOptions options = few_scans();
    options.sweep = true;
    Simulation simulation(options);
    const SimulatedScan scan = simulation.scan(3);
    const auto beams = exact_beams(simulation, scan);
    EXPECT_EQ(beams.front().origin,
              simulation.exact_pose(scan.stamp + double{scan.times.front()}).translation());
    EXPECT_GT((beams.back().origin - beams.front().origin).norm(), 0.05);
    options.sweep = false;
    Simulation at_once(options);
    const SimulatedScan other = at_once.scan(3);
    EXPECT_NEAR(mean_height(beams, scan), mean_height(exact_beams(at_once, other), other), 0.02);
}

}  // namespace knowable_test
}  // namespace dynamic_filter::sim
