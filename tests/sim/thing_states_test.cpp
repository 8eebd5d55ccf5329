// SPDX-License-Identifier: MIT
#include "sim/thing_states.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::sim {
namespace thing_states_test {

constexpr double kPeriod = 0.25;  // [s] so that motion is measured from the scan before to the next

/// A thing of 1 m whose near end is at x [m].
SeenThing thing_at(double x, std::size_t points = 20) {
    return {Eigen::AlignedBox2d(Eigen::Vector2d(x, 0.0), Eigen::Vector2d(x + 1.0, 1.0)), points};
}

/// The states of thing 1, by scan.
std::vector<ThingState> states(const std::vector<SeenThing>& scans) {
    std::vector<SeenThings> seen;
    std::vector<double> stamps;
    for (const SeenThing& thing : scans) {
        stamps.push_back(kPeriod * static_cast<double>(seen.size()));
        seen.push_back({{1, thing}});
    }
    std::vector<ThingState> out;
    for (const StatesOfThings& of_scan : states_of(seen, stamps)) {
        out.push_back(of_scan.at(1).state);
    }
    return out;
}

constexpr auto kMoves = ThingState::moves, kMoved = ThingState::moved,
               kWill = ThingState::will_move, kNever = ThingState::never;

TEST(ThingStates, AThingRestsMovesAndRests) {
    std::vector<SeenThing> scans(4, thing_at(0.0));
    scans.push_back(thing_at(1.0));
    scans.resize(8, thing_at(2.0));
    EXPECT_EQ(states(scans),
              (std::vector{kWill, kWill, kWill, kMoves, kMoves, kMoves, kMoved, kMoved}));
}

TEST(ThingStates, SlowThingsRest) {
    std::vector<SeenThing> scans;
    for (int i = 0; i < 5; ++i) scans.push_back(thing_at(0.4 * kPeriod * i));
    EXPECT_EQ(states(scans), std::vector(5, kNever));
    for (int i = 0; i < 5; ++i) scans[static_cast<std::size_t>(i)] = thing_at(0.6 * kPeriod * i);
    EXPECT_EQ(states(scans), std::vector(5, kMoves));
}

TEST(ThingStates, WhatIsUncoveredStepByStepRests) {
    std::vector<SeenThing> scans(5, thing_at(0.0));
    for (std::size_t i = 0; i < scans.size(); ++i) {
        scans[i].box.extend(Eigen::Vector2d(1.0 + static_cast<double>(i), 0.0));
    }
    EXPECT_EQ(states(scans), std::vector(5, kNever));
}

TEST(ThingStates, FewPointsAreNotSeenToMove) {
    std::vector<SeenThing> scans(3, thing_at(0.0, 19));
    scans.resize(6, thing_at(2.0, 19));
    EXPECT_EQ(states(scans), (std::vector{kNever, kNever, kMoves, kMoves, kNever, kNever}));
    const auto marks = states_of(std::vector{SeenThings{{1, scans[0]}}, SeenThings{{1, scans[5]}}},
                                 std::vector{0.0, 0.5});
    EXPECT_EQ(marks[0].at(1).state, kMoves);
    EXPECT_FALSE(marks[0].at(1).is_seen_moving);
}

TEST(ThingStates, WhatIsSeenOnceNeverMoves) {
    EXPECT_EQ(states({thing_at(0.0)}), std::vector{kNever});
}

TEST(ThingStates, ThingsAreSeenFromAboveAndStaticPointsAreNoThing) {
    const std::vector<Eigen::Vector3d> world{{0, 0, 9}, {1, 2, 3}, {3, 1, -5}, {7, 7, 7}};
    const SeenThings seen = seen_things(world, std::vector<std::uint32_t>{0, 4, 4, 5});
    ASSERT_EQ(seen.size(), 2U);
    EXPECT_EQ(seen.at(4).points, 2U);
    EXPECT_EQ(seen.at(4).box.min(), Eigen::Vector2d(1, 1));
    EXPECT_EQ(seen.at(4).box.max(), Eigen::Vector2d(3, 2));
}

TEST(ThingStates, ThingsThatRestDuringADriveAreNumberedOnTheirOwn) {
    EXPECT_EQ(thing_of(Kind::structure, 3), 0U);
    EXPECT_EQ(thing_of(Kind::vehicle, 3), thing_of(Kind::walking, 3));
    EXPECT_NE(thing_of(Kind::vehicle, 3), thing_of(Kind::temporary, 3));
}

}  // namespace thing_states_test
}  // namespace dynamic_filter::sim
