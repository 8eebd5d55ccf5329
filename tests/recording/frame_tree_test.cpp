// SPDX-License-Identifier: MIT
#include "recording/frame_tree.hpp"

#include "support/bytes.hpp"
#include "support/random.hpp"

namespace dynamic_filter::io {
namespace frame_tree_test {

Pose along(double x) { return Pose(Eigen::Translation3d(x, 0, 0)); }

/// map -> odom -> base -> lidar; odom -> base moves 1 m/s, from 0 to 10 s.
FrameTree vehicle() {
    FrameTree frames;
    for (int i = 10; i >= 0; --i) frames.add({double(i), "odom", "base", along(i)}, false);
    frames.add({0.0, "map", "odom", along(100)}, true);
    frames.add({0.0, "base", "lidar", Pose(Eigen::Translation3d(0, 0, 2))}, true);
    frames.put_in_order();
    return frames;
}

TEST(FrameTree, Chain) {
    const FrameTree frames = vehicle();
    EXPECT_EQ(frames.above("lidar"), (std::vector<std::string>{"lidar", "base", "odom", "map"}));
    EXPECT_EQ(frames.above("stranger"), std::vector<std::string>{"stranger"});
    const auto pose = frames.pose("lidar", "map", 2.5);
    ASSERT_TRUE(pose);
    EXPECT_TRUE(pose->translation().isApprox(Eigen::Vector3d(102.5, 0, 2)));
    const auto back = frames.pose("map", "lidar", 2.5);
    ASSERT_TRUE(back);
    EXPECT_TRUE((*back * *pose).isApprox(Pose::Identity(), 1e-12));
    EXPECT_TRUE(frames.pose("lidar", "lidar", 2.5)->isApprox(Pose::Identity(), 1e-12));
}

TEST(FrameTree, WhatIsFixedBelow) {
    FrameTree frames = vehicle();
    frames.add({0.0, "lidar", "optics", along(1)}, true);
    EXPECT_EQ(frames.fixed_below("base"), (std::vector<std::string>{"lidar", "optics"}));
    EXPECT_EQ(frames.fixed_below("map"), std::vector<std::string>{"odom"});
    EXPECT_TRUE(frames.fixed_below("optics").empty());
    EXPECT_TRUE(frames.fixed_below("stranger").empty());
}

TEST(FrameTree, TimesThatAreNotKnown) {
    const FrameTree frames = vehicle();
    EXPECT_FALSE(frames.pose("lidar", "map", 11.0));
    EXPECT_FALSE(frames.pose("lidar", "map", -1.0));
    EXPECT_TRUE(frames.pose("odom", "map", 1e9));  // static links have no time
    EXPECT_FALSE(frames.pose("lidar", "stranger", 5.0));
}

TEST(FrameTree, WhatMoves) {
    const FrameTree frames = vehicle();
    EXPECT_TRUE(frames.moves("lidar"));
    EXPECT_TRUE(frames.moves("base"));
    EXPECT_FALSE(frames.moves("odom"));
    EXPECT_FALSE(frames.moves("stranger"));
    EXPECT_EQ(frames.stamps_above("lidar").size(), 11U);
}

TEST(FrameTree, TwoFramesOfOneRoot) {
    FrameTree frames = vehicle();
    frames.add({0.0, "base", "rear", along(-3)}, true);
    const auto pose = frames.pose("rear", "lidar", 4.0);
    ASSERT_TRUE(pose);
    EXPECT_TRUE(pose->translation().isApprox(Eigen::Vector3d(-3, 0, -2)));
}

TEST(FrameTree, KeepsTheFirstParent) {
    FrameTree frames = vehicle();
    frames.add({0.0, "elsewhere", "base", along(7)}, true);
    frames.put_in_order();
    EXPECT_EQ(frames.above("base").at(1), "odom");
    EXPECT_TRUE(frames.pose("base", "odom", 0.0)->isApprox(along(0)));
}

TEST(FrameTree, EveryParentThatMovesIsAReading) {
    FrameTree frames = vehicle();
    for (int i = 0; i <= 10; ++i) frames.add({double(i), "slam", "base", along(2 * i)}, false);
    frames.put_in_order();
    const auto readings = frames.readings("lidar");
    ASSERT_EQ(readings.size(), 2U);
    EXPECT_EQ(readings[0].link, "'base' in 'odom'");
    EXPECT_EQ(readings[1].link, "'base' in 'slam'");
    EXPECT_NEAR(readings[1].tree.pose("lidar", "slam", 4.0)->translation().x(), 8.0, 1e-9);
    EXPECT_EQ(vehicle().readings("lidar").size(), 1U);
}

TEST(FrameTree, TwoAuthorsOfOneLinkAreToldApart) {
    FrameTree frames;
    for (int i = 0; i < 100; ++i) {
        frames.add({0.1 * i, "odom", "base", along(0.02 * i)}, false);
        frames.add({0.1 * i + 0.03, "odom", "base", along(0.02 * i + 0.5)}, false);
    }
    frames.put_in_order();
    const auto readings = frames.readings("base");
    ASSERT_EQ(readings.size(), 2U);
    EXPECT_NEAR(readings[0].tree.pose("base", "odom", 5.0)->translation().x(), 1.0, 0.01);
    EXPECT_NEAR(readings[1].tree.pose("base", "odom", 5.03)->translation().x(), 1.5, 0.01);
}

TEST(FrameTree, LinksThatNeverChangeAreStaticIfAsked) {
    FrameTree frames = vehicle();
    for (int i = 0; i <= 10; ++i) frames.add({double(i), "lidar", "lens", along(0.1)}, false);
    frames.add({0.0, "lidar", "once", along(0.1)}, false);
    frames.put_in_order();
    EXPECT_TRUE(frames.fixed_below("lidar").empty());
    frames.fix_constant_links();
    EXPECT_EQ(frames.fixed_below("lidar"), (std::vector<std::string>{"lens", "once"}));
    EXPECT_TRUE(frames.moves("lens"));
    EXPECT_EQ(frames.moving_below("odom"),
              (std::vector<std::string>{"base", "lens", "lidar", "once"}));
    EXPECT_NEAR(frames.reach_above("lens"), 10.0, 1e-9);
}

TEST(FrameTree, CirclesEnd) {
    FrameTree frames;
    frames.add({0.0, "a", "b", along(1)}, true);
    frames.add({0.0, "b", "a", along(1)}, true);
    frames.add({0.0, "c", "c", along(1)}, true);
    frames.put_in_order();
    EXPECT_EQ(frames.above("a"), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(frames.above("c"), std::vector<std::string>{"c"});
    EXPECT_FALSE(frames.pose("a", "b", 0.0));  // there is no root to compare them in
    EXPECT_FALSE(frames.moves("a"));
}

TEST(FrameTree, TurningLinksCompose) {
    test::Random random(2);
    FrameTree frames;
    const Pose a = random.pose(5.0, 3.0), b = random.pose(5.0, 3.0), c = random.pose(5.0, 3.0);
    frames.add({0.0, "root", "a", a}, true);
    frames.add({0.0, "a", "b", b}, true);
    frames.add({0.0, "root", "c", c}, true);
    frames.put_in_order();
    EXPECT_TRUE(frames.pose("b", "root", 0.0)->isApprox(a * b, 1e-12));
    EXPECT_TRUE(frames.pose("b", "c", 0.0)->isApprox(c.inverse() * a * b, 1e-12));
}

/// odom -> base moves 1 m/s, every 0.1 s; map -> odom corrects it every 3 s.
FrameTree corrected(double odometry_step = 0.1) {
    FrameTree frames;
    for (double t = 0.0; t <= 10.0; t += odometry_step) {
        frames.add({t, "odom", "base", along(t)}, false);
    }
    for (const double t : {1.0, 4.0, 7.0}) frames.add({t, "map", "odom", along(0.2 * t)}, false);
    frames.put_in_order();
    return frames;
}

TEST(FrameTree, CorrectionsAreHeld) {
    const FrameTree frames = corrected();
    const LinkLookup holding{.gap = 0.25, .holds = true};
    for (double t = 0.03; t < 10.0; t += 0.1) {
        const double correction = t < 4.0 ? 0.2 : t < 7.0 ? 0.8 : 1.4;
        const auto pose = frames.pose("base", "map", t, holding);
        ASSERT_TRUE(pose) << t;
        EXPECT_NEAR(pose->translation().x(), t + correction, 1e-9) << t;
    }
    EXPECT_FALSE(frames.pose("base", "map", 2.5))
        << "live, a correction that is late is waited for";
    EXPECT_EQ(frames.stamps_above("base").size(), 101U);
}

TEST(FrameTree, TheMotionItselfIsNotHeld) {
    const FrameTree frames = corrected(1.0);
    const LinkLookup holding{.gap = 0.25, .holds = true};
    EXPECT_TRUE(frames.pose("base", "map", 5.0, holding));
    EXPECT_FALSE(frames.pose("base", "map", 5.5, holding));
    // Nor if a joint of the vehicle is published more often.
    FrameTree with_joint = corrected(1.0);
    for (double t = 0.0; t <= 10.0; t += 0.02) {
        with_joint.add({t, "base", "lidar", along(0.5)}, false);
    }
    with_joint.put_in_order();
    EXPECT_FALSE(with_joint.pose("lidar", "map", 5.5, holding));
    EXPECT_EQ(with_joint.stamps_above("lidar").size(), 11U);
}

}  // namespace frame_tree_test
}  // namespace dynamic_filter::io
