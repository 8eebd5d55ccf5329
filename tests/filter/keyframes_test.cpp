// SPDX-License-Identifier: MIT
#include "filter/keyframes.hpp"

#include <gtest/gtest.h>

#include "support/room.hpp"

namespace dynamic_filter {
namespace keyframes_test {

Scan room_scan(std::size_t index, double stamp, double x) {
    Pose pose = Pose::Identity();
    pose.translation() = Eigen::Vector3d(x, 0.25, 1.0);
    const test::Box room{{-20.0, -6.0, 0.0}, {20.0, 6.0, 3.0}};
    Scan scan = test::scan_room(pose, room, {}).scan;
    scan.stamp = stamp;
    scan.index = index;
    return scan;
}

Config config_of(double interval, double distance) {
    Config config;
    config.keyframe = {.interval = interval, .distance = distance};
    return config;
}

TEST(Keyframes, OnlyKeyframesObserve) {
    Keyframes observers(config_of(1.0, 100.0));
    EXPECT_TRUE(observers.add(room_scan(0, 0.0, 0.0)));
    EXPECT_FALSE(observers.add(room_scan(1, 0.5, 0.0)));
    EXPECT_TRUE(observers.add(room_scan(2, 1.0, 0.0)));
    EXPECT_EQ(observers.total(), 2U);
    EXPECT_EQ(observers.kept().back().index, 2U);
}

TEST(Keyframes, WhatMovedSoonAfterTheLastLooksNoFartherThanNear) {
    Config config = config_of(1.0, 0.5);
    config.scans.observers.near_reach = 40.0;
    Keyframes observers(config);
    observers.add(room_scan(0, 0.0, 0.0));
    observers.add(room_scan(1, 0.2, 0.6));  // by distance
    observers.add(room_scan(2, 1.3, 0.6));  // by time
    EXPECT_EQ(observers.kept()[0].reach, 80.0F);
    EXPECT_EQ(observers.kept()[1].reach, 40.0F);
    EXPECT_EQ(observers.kept()[2].reach, 80.0F);
}

// Two sensors take turns, and are two metres apart: neither moves.
TEST(Keyframes, EachOfSeveralSensorsIsAsIfAlone) {
    Config config = config_of(1.0, 0.5);
    config.scans.max_keyframes = 2;
    Keyframes both(config), alone(config);
    for (std::size_t i = 0; i < 40; ++i) {
        const double stamp = 0.1 * static_cast<double>(i);
        Scan scan = room_scan(i, stamp, i % 2 == 0 ? 0.0 : 2.0);
        scan.sensor = i % 2;
        const bool added = both.add(scan);
        if (i % 2 == 0) {
            EXPECT_EQ(added, alone.add(scan));
        }
    }
    EXPECT_EQ(both.total(), 2 * alone.total());
    EXPECT_EQ(both.kept().size(), 2 * alone.kept().size());
}

TEST(Keyframes, KeepsTheNewestOnly) {
    Config config = config_of(0.0, 1.0);
    config.scans.max_keyframes = 3;
    Keyframes observers(config);
    for (std::size_t i = 0; i < 7; ++i) observers.add(room_scan(i, static_cast<double>(i), 0.0));
    ASSERT_EQ(observers.kept().size(), 3U);
    EXPECT_EQ(observers.kept().front().index, 4U);
    EXPECT_EQ(observers.total(), 7U);
}

// Those that are asked stand for all: their weights add up to about the number of keyframes.
TEST(Keyframes, ANewVoxelAsksTheNewestOneByOneAndOfOlderOnesFewer) {
    Config config = config_of(0.0, 1.0);
    config.scans.observers.images_asked = 8.0;
    Keyframes observers(config);
    EXPECT_TRUE(observers.asked_by_new().empty());
    for (std::size_t i = 0; i < 100; ++i) observers.add(room_scan(i, static_cast<double>(i), 0.0));
    const auto asked = observers.asked_by_new();
    EXPECT_LT(asked.size(), 60U);
    EXPECT_EQ(asked.back().keyframe->index, 99U);
    EXPECT_EQ(asked.back().weight, 1U);
    EXPECT_GT(asked.front().weight, 1U);
    unsigned weights = 0;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        weights += asked[i].weight;
        if (i == 0) continue;
        EXPECT_LT(asked[i - 1].keyframe->index, asked[i].keyframe->index);
    }
    EXPECT_NEAR(weights, 100, 10);
}

TEST(Keyframes, AFewPointsDoNotTellTheBeamPattern) {
    Keyframes observers(config_of(0.0, 1.0));
    Scan few;
    few.points = {{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    observers.add(few);
    EXPECT_FALSE(observers.beams());
    observers.add(room_scan(1, 1.0, 0.0));
    EXPECT_TRUE(observers.beams());
}

// Another drive may begin at any time of the day.
TEST(Keyframes, TheFirstScanOfADriveIsAKeyframeThatLooksFar) {
    Keyframes observers(config_of(1.0, 100.0));
    observers.add(room_scan(0, 1000.0, 0.0));
    observers.begin_drive();
    EXPECT_TRUE(observers.kept().empty());
    EXPECT_FALSE(observers.beams());
    EXPECT_TRUE(observers.add(room_scan(1, 3.0, 0.0)));
    EXPECT_EQ(observers.kept().back().reach, 80.0F);
}

}  // namespace keyframes_test
}  // namespace dynamic_filter
