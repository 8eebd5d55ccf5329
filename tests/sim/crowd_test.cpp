// SPDX-License-Identifier: MIT
#include "sim/crowd.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace dynamic_filter::sim::crowd_test {

using Eigen::Vector2d;

namespace {

std::vector<Mover> no_movers(double) { return {}; }

CrowdPlan corridor() {
    CrowdPlan plan;
    plan.field = distance_field(
        {{.centre = {0, 3}, .half = {20, 0.2}}, {.centre = {0, -3}, .half = {20, 0.2}}}, {-20, -4},
        {20, 4});
    plan.movers = no_movers;
    return plan;
}

Walker walker(const Vector2d& start, const std::vector<Vector2d>& route) {
    Walker out;
    out.start = start;
    for (const auto& p : route) out.route.push_back({.at = p});
    return out;
}

}  // namespace

TEST(Crowd, WalksItsRouteAtItsSpeed) {
    CrowdPlan plan = corridor();
    plan.walkers = {walker({-15, 0}, {{15, 0}, {-15, 0}})};
    const Crowd crowd = simulate_crowd(plan, 60.0);
    double way = 0.0;
    for (double t = 0.0; t < 60.0; t += 0.5) {
        way += static_cast<double>(
            (stride_at(crowd, 0, t + 0.5).position - stride_at(crowd, 0, t).position).norm());
    }
    EXPECT_NEAR(way / 60.0, 1.2, 0.1);
}

TEST(Crowd, SpeedIsThatOfThePositions) {
    CrowdPlan plan = corridor();
    plan.walkers = {walker({-10, 0}, {{10, 0}, {-10, 0}})};
    plan.walkers[0].route[0].pause = 5.0;
    const Crowd crowd = simulate_crowd(plan, 30.0);
    for (double t = crowd_step; t < 29.0; t += crowd_step) {
        const auto before = stride_at(crowd, 0, t - crowd_step);
        const auto now = stride_at(crowd, 0, t);
        const float moved = (now.position - before.position).norm();
        EXPECT_NEAR(now.speed, moved / static_cast<float>(crowd_step), 0.01F) << t;
    }
}

TEST(Crowd, OpposingWalkersPass) {
    CrowdPlan plan = corridor();
    plan.walkers = {walker({-15, 0}, {{15, 0}, {-15, 0}}), walker({15, 0.05}, {{-15, 0}, {15, 0}})};
    const Crowd crowd = simulate_crowd(plan, 40.0);
    for (double t = 0.0; t < 40.0; t += 0.05) {
        const auto a = stride_at(crowd, 0, t).position, b = stride_at(crowd, 1, t).position;
        EXPECT_GT((a - b).norm(), 0.36F);
        EXPECT_LT(std::abs(a.y()), 2.6F);
    }
}

TEST(Crowd, StandsForItsPauseWithLegsAtRest) {
    CrowdPlan plan = corridor();
    plan.walkers = {walker({-10, 0}, {{15, 0}, {-15, 0}})};
    plan.walkers[0].route[0].pause = 10.0;
    plan.walkers[0].route[0].face = {15, 2};
    const Crowd crowd = simulate_crowd(plan, 40.0);
    int still = 0;
    for (double t = 0.0; t < 40.0; t += 0.1) {
        const Stride s = stride_at(crowd, 0, t);
        if (s.swing > 0.01F) continue;
        ++still;
        EXPECT_LT(s.speed, 0.2F);
        EXPECT_GT(s.position.x(), 13.5F);
    }
    EXPECT_NEAR(still * 0.1, 8.5, 2.0);
}

TEST(Crowd, StandsUntilItIsReleased) {
    CrowdPlan plan = corridor();
    plan.walkers = {walker({0, 0}, {{0, 0}, {10, 0}, {10, 2}})};
    plan.walkers[0].route[0].release = [](double t) { return std::max(t, 20.0); };
    plan.walkers[0].route[2].release = [](double) { return 1e9; };
    const Crowd crowd = simulate_crowd(plan, 60.0);
    EXPECT_LT(stride_at(crowd, 0, 19.5).position.norm(), 0.3F);
    EXPECT_GT(stride_at(crowd, 0, 24.0).position.x(), 2.0F);
    for (const double t : {45.0, 59.0})
        EXPECT_LT((stride_at(crowd, 0, t).position - Eigen::Vector2f(10, 2)).norm(), 0.3F);
}

TEST(Crowd, WaitsAtTheKerbForVehicles) {
    CrowdPlan plan = corridor();
    plan.walkers = {walker({0, -2}, {{0, -2}, {0, 2}})};
    plan.walkers[0].route[0].gated = true;
    plan.movers = [](double t) {  // a car every ten seconds
        std::vector<Mover> out;
        for (int k = -2; k < 6; ++k) {
            out.push_back(
                {.centre = {10.0 * (t - 10.0 * k), 0.0}, .velocity = {10, 0}, .radius = 0.9});
        }
        return out;
    };
    const Crowd crowd = simulate_crowd(plan, 40.0);
    int crossings = 0;
    float before = stride_at(crowd, 0, 0.0).position.y();
    for (double t = 0.05; t < 40.0; t += 0.05) {
        const auto p = stride_at(crowd, 0, t).position;
        crossings += before < 0.0F && p.y() >= 0.0F;
        before = p.y();
        for (const Mover& car : plan.movers(t)) {
            EXPECT_GT((car.centre - p.cast<double>()).norm(), car.radius + 0.2);
        }
    }
    EXPECT_GE(crossings, 1);
}

TEST(Crowd, YieldsToTheRobot) {
    CrowdPlan plan = corridor();
    plan.walkers = {walker({-10, 0}, {{15, 0}, {-15, 0}})};
    plan.walkers[0].speed = 0.7;
    plan.movers = [](double t) {
        return std::vector<Mover>{{.centre = {-18.0 + t, 0.0}, .velocity = {1, 0}, .radius = 0.4}};
    };
    const Crowd crowd = simulate_crowd(plan, 30.0);
    for (double t = 0.0; t < 30.0; t += 0.05) {
        const Eigen::Vector2d p = stride_at(crowd, 0, t).position.cast<double>();
        EXPECT_GT((p - plan.movers(t)[0].centre).norm(), 0.6);
    }
}

}  // namespace dynamic_filter::sim::crowd_test
