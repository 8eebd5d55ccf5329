// SPDX-License-Identifier: MIT
// Labels of scans without poses are hardly worse than those at exact poses.
#include <gtest/gtest.h>

#include <iostream>

#include "dynamic_filter/online.hpp"
#include "dynamic_filter/scores.hpp"
#include "dynamic_filter/simulation.hpp"

namespace dynamic_filter {
namespace without_poses_test {

std::vector<sim::SimulatedScan> crowd() {
    sim::SimulationOptions options;
    options.frames = 60;
    options.seed = 7;
    sim::Simulation simulation(options);
    std::vector<sim::SimulatedScan> scans;
    for (std::size_t i = 0; i < simulation.size(); ++i) scans.push_back(simulation.scan(i));
    return scans;
}

/// The scans are given the poses T_world_truth * true pose, or none.
double f1_of(const std::vector<sim::SimulatedScan>& scans,
             const std::optional<Pose>& T_world_truth) {
    OnlineFilter filter(Config{}, {.overload = Overload::wait, .horizon = 0.0, .max_bytes = 0});
    std::vector<Scan> given;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        given.push_back({scans[i].points, Pose::Identity(), scans[i].stamp, i, false});
        Scan& scan = given.back();
        if (T_world_truth) scan.T_world_sensor = *T_world_truth * scans[i].T_world_sensor;
        scan.has_pose = T_world_truth.has_value();
        const auto verdict = filter.ask(scan);
        if (!T_world_truth) scan.T_world_sensor = verdict.value().tracked->T_world_sensor;
        scan.has_pose = true;
    }
    filter.finish();
    std::vector<eval::LabelledScan> judged;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        Points in_world;
        for (const Point& p : scans[i].points) {
            in_world.push_back((scans[i].T_world_sensor * p.cast<double>()).cast<float>());
        }
        judged.push_back({std::move(in_world), scans[i].labels, filter.verdict(given[i]).labels});
    }
    const auto scores = eval::score_labels(
        judged.size(), [&](std::size_t i) { return std::optional(judged[i]); }, eval::kVoxelSize);
    return scores.voxel.at("excluded").f1.value();
}

TEST(WithoutPoses, LabelsAreHardlyWorse) {
    const auto scans = crowd();
    const Pose T_first_truth = scans[0].T_world_sensor.inverse();
    // where the borders of voxels lie is chance: so three times, a part of a voxel apart
    double with_poses = 0.0;
    for (const double shift : {0.0, 0.07, 0.13}) {
        with_poses += f1_of(scans, Eigen::Translation3d(shift, shift, shift) * T_first_truth) / 3.0;
    }
    const double without = f1_of(scans, std::nullopt);
    std::cerr << "crowd: F1 " << without << " without poses, " << with_poses << " with them\n";
    EXPECT_GT(with_poses, 0.9);
    EXPECT_GE(without, with_poses - 0.006);
}

}  // namespace without_poses_test
}  // namespace dynamic_filter
