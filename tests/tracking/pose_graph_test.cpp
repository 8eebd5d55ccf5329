// SPDX-License-Identifier: MIT
#include "tracking/pose_graph.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter {
namespace pose_graph_test {

constexpr std::size_t kPoses = 30;

/// A path that bends and climbs.
std::vector<Pose> bent_path() {
    Twist step;
    step << 1.0, 0.1, 0.05, 0.01, -0.02, 0.1;
    std::vector<Pose> poses = {Pose(Eigen::Translation3d(5.0, -3.0, 1.0))};
    while (poses.size() < kPoses) poses.push_back(poses.back() * exp(step));
    return poses;
}

std::vector<Motion> chain_of(const std::vector<Pose>& poses, const Twist& error) {
    std::vector<Motion> motions;
    for (std::size_t i = 1; i < poses.size(); ++i) {
        motions.push_back({i - 1, i, poses[i - 1].inverse() * poses[i] * exp(error),
                           1e4 * Information::Identity()});
    }
    return motions;
}

double farthest(const std::vector<Pose>& a, const std::vector<Pose>& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        most = std::max(most, (a[i].translation() - b[i].translation()).norm());
    }
    return most;
}

PoseHint hint_at(std::size_t scan, const Pose& pose) {
    return {scan, pose, 1e4 * Information::Identity()};
}

TEST(PoseGraph, AChainThatFitsStaysWhereItIs) {
    const std::vector<Pose> truth = bent_path();
    EXPECT_LT(farthest(solve_pose_graph(truth, chain_of(truth, Twist::Zero()), {}), truth), 1e-9);
    EXPECT_TRUE(solve_pose_graph({}, {}, {}).empty());
}

TEST(PoseGraph, MotionsAloneGiveThePathFromItsFirstPose) {
    const std::vector<Pose> truth = bent_path();
    std::vector<Pose> start(kPoses, truth.front());
    EXPECT_LT(farthest(solve_pose_graph(start, chain_of(truth, Twist::Zero()), {}), truth), 1e-4);
}

TEST(PoseGraph, ManyHintsUndoTheDriftOfTheChain) {
    const std::vector<Pose> truth = bent_path();
    Twist drift = Twist::Zero();
    drift[0] = 0.02;
    drift[5] = 0.005;
    std::vector<PoseHint> hints;
    for (std::size_t i = 0; i < kPoses; ++i) hints.push_back(hint_at(i, truth[i]));
    const auto solved = solve_pose_graph(truth, chain_of(truth, drift), hints);
    EXPECT_LT(farthest(solved, truth), 0.06);
}

TEST(PoseGraph, AWrongHintAmongManyIsIgnored) {
    const std::vector<Pose> truth = bent_path();
    std::vector<PoseHint> hints;
    for (std::size_t i = 0; i < kPoses; i += 3) hints.push_back(hint_at(i, truth[i]));
    hints[5].T_world_sensor.translation().y() += 4.0;
    const auto solved = solve_pose_graph(truth, chain_of(truth, Twist::Zero()), hints);
    EXPECT_LT(farthest(solved, truth), 0.02);
}

TEST(PoseGraph, AWrongLoopIsIgnoredAndTrueOnesAreClosed) {
    const std::vector<Pose> truth = bent_path();
    Twist drift = Twist::Zero();
    drift[1] = 0.01;
    std::vector<Motion> motions = chain_of(truth, drift);
    const auto loop = [&](std::size_t from, std::size_t to) {
        return Motion{from, to, truth[from].inverse() * truth[to], 1e4 * Information::Identity(),
                      true};
    };
    const double open = farthest(solve_pose_graph(truth, motions, {}), truth);
    for (std::size_t k = 0; k < 5; ++k) motions.push_back(loop(k, kPoses - 5 + k));
    motions.push_back(loop(2, 20));
    motions.back().T_from_to.translation().x() += 6.0;
    EXPECT_LT(farthest(solve_pose_graph(truth, motions, {}), truth), 0.2 * open);
}

/// Sum of the squared errors, in multiples of what the information expects.
double cost_of(const std::vector<Pose>& poses, const std::vector<Motion>& motions,
               const std::vector<PoseHint>& hints) {
    double cost = 0.0;
    for (const Motion& m : motions) {
        const Twist error = log(m.T_from_to.inverse() * poses[m.from].inverse() * poses[m.to]);
        cost += error.dot(m.information * error);
    }
    for (const PoseHint& hint : hints) {
        const Twist error = log(hint.T_world_sensor.inverse() * poses[hint.scan]);
        cost += error.dot(hint.information * error);
    }
    return cost;
}

TEST(PoseGraph, NoSmallDisplacementOfASolutionFitsBetter) {
    const std::vector<Pose> truth = bent_path();
    Twist drift = Twist::Zero();
    drift[0] = 0.002;
    drift[4] = 0.0005;
    const std::vector<Motion> motions = chain_of(truth, drift);
    const std::vector<PoseHint> hints = {hint_at(0, truth.front()), hint_at(15, truth[15]),
                                         hint_at(kPoses - 1, truth.back())};
    const std::vector<Pose> solved = solve_pose_graph(truth, motions, hints);
    const double least = cost_of(solved, motions, hints);
    EXPECT_LT(least, cost_of(truth, motions, hints));
    for (const std::size_t i : {1U, 14U, 15U, 28U}) {
        for (Eigen::Index axis = 0; axis < 6; ++axis) {
            for (const double step : {-1e-3, 1e-3}) {
                std::vector<Pose> moved = solved;
                Twist displacement = Twist::Zero();
                displacement[axis] = step;
                moved[i] = moved[i] * exp(displacement);
                EXPECT_GT(cost_of(moved, motions, hints), least) << i << " " << axis;
            }
        }
    }
}

}  // namespace pose_graph_test
}  // namespace dynamic_filter
