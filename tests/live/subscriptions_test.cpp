// SPDX-License-Identifier: MIT
#include "live/subscriptions.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "dynamic_filter/error.hpp"
#include "live/fake_bus.hpp"

namespace dynamic_filter::live {
namespace subscriptions_test {

const Quality kReliable{.reliable = true, .latched = false, .depth = 1};
const Quality kBestEffort{.reliable = false, .latched = false, .depth = 1};
const Quality kLatched{.reliable = true, .latched = true, .depth = 1};

SeenTopic clouds(const std::string& name, const Quality& offered = kReliable) {
    return {name, "sensor_msgs/PointCloud2", 1, offered};
}
const SeenTopic kTf{"/tf", "tf2_msgs/TFMessage", 1, kReliable};
const SeenTopic kTfStatic{"/tf_static", "tf2_msgs/TFMessage", 1, kLatched};
const SeenTopic kOdometry{"/odom", "nav_msgs/Odometry", 1, kReliable};
const SeenTopic kGoal{"/goal_pose", "geometry_msgs/PoseStamped", 1, kReliable};

struct Robot {
    LiveConfig config;
    test::FakeBus bus;
    std::optional<Intake> intake;
    std::optional<Subscriptions> subscriptions;

    Subscriptions& start() {
        intake.emplace(config);
        subscriptions.emplace(bus, config, *intake);
        return *subscriptions;
    }
    /// Topics of scans are chosen a moment after the first was seen.
    void update_twice() {
        subscriptions->update();
        std::this_thread::sleep_for(std::chrono::milliseconds(1100));
        subscriptions->update();
    }
};

TEST(Subscriptions, SensorsOfOneVehicleAreAllReceivedAsTheyCome) {
    Robot robot;
    robot.config.input.cloud = "/front /rear";
    robot.bus.others = {clouds("/front"), clouds("/other"), kTf};
    robot.start();
    robot.subscriptions->update();
    EXPECT_EQ(robot.subscriptions->clouds(), std::vector<std::string>{"/front"});
    robot.bus.others.push_back(clouds("/rear"));
    robot.subscriptions->update();
    EXPECT_EQ(robot.subscriptions->clouds(), (std::vector<std::string>{"/front", "/rear"}));
    EXPECT_TRUE(robot.bus.subscribed.contains("/rear"));
    EXPECT_FALSE(robot.bus.subscribed.contains("/other"));
}

TEST(Subscriptions, TheOnlyTopicOfScansIsChosenWithAllThatLeadsToPoses) {
    Robot robot;
    robot.bus.others = {clouds("/points"),
                        kTf,
                        kTfStatic,
                        kOdometry,
                        {"/image", "sensor_msgs/Image", 1, kReliable}};
    robot.start();
    robot.update_twice();
    EXPECT_EQ(robot.subscriptions->cloud(), "/points");
    EXPECT_EQ(robot.bus.subscribed.size(), 4U);
    EXPECT_TRUE(robot.bus.subscribed.at("/tf_static").latched);
    EXPECT_FALSE(robot.bus.subscribed.contains("/image"));
    robot.subscriptions->update();
    for (const auto& [name, count] : robot.bus.subscriptions) EXPECT_EQ(count, 1U) << name;
}

TEST(Subscriptions, OfSeveralTopicsTheUserChooses) {
    Robot robot;
    robot.bus.others = {clouds("/front"), clouds("/rear")};
    robot.start();
    robot.subscriptions->update();
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    try {
        robot.subscriptions->update();
        FAIL() << "expected an error";
    } catch (const ConfigError& error) {
        EXPECT_NE(std::string(error.what()).find("/front, /rear"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("--set input.cloud=TOPIC"), std::string::npos);
    }
    Robot chosen;
    chosen.config.input.cloud = "/rear";
    chosen.bus.others = robot.bus.others;
    chosen.start().update();
    EXPECT_EQ(chosen.subscriptions->cloud(), "/rear");
    EXPECT_FALSE(chosen.bus.subscribed.contains("/front"));
}

TEST(Subscriptions, OutputsOfAnotherInstanceAreNoScans) {
    const auto topics = usable({clouds("/points"), clouds("/rear_filter/static"),
                                clouds("/rear_filter/labels"), clouds("/rear_filter/corrections")});
    ASSERT_EQ(topics.clouds.size(), 1U);
    EXPECT_EQ(topics.clouds[0].name, "/points");
}

TEST(Subscriptions, AsMuchIsAskedForAsAllPublishersOffer) {
    Robot robot;
    robot.config.input.cloud = "/points";
    robot.bus.others = {clouds("/points")};
    robot.start().update();
    EXPECT_TRUE(robot.bus.subscribed.at("/points").reliable);
    robot.bus.others = {clouds("/points", kBestEffort)};
    robot.subscriptions->update();
    EXPECT_FALSE(robot.bus.subscribed.at("/points").reliable);
    EXPECT_EQ(robot.bus.subscriptions.at("/points"), 2U);
    EXPECT_EQ(robot.subscriptions->pop_notices().size(), 1U);
    robot.bus.others = {clouds("/points")};
    robot.subscriptions->update();
    EXPECT_EQ(robot.bus.subscriptions.at("/points"), 2U) << "best effort fits all";
}

TEST(Subscriptions, TheUserMayAskForLess) {
    Robot robot;
    robot.config.input.cloud = "/points";
    robot.config.input.qos = "best_effort";
    robot.bus.others = {clouds("/points")};
    robot.start().update();
    EXPECT_FALSE(robot.bus.subscribed.at("/points").reliable);
}

TEST(Subscriptions, OnlyTheNamedTopicOfPosesIsReceived) {
    Robot robot;
    robot.config.input.pose = "/odom";
    robot.bus.others = {kOdometry, kGoal};
    robot.start().update();
    EXPECT_TRUE(robot.bus.subscribed.contains("/odom"));
    EXPECT_FALSE(robot.bus.subscribed.contains("/goal_pose"));
}

TEST(Subscriptions, TheEndStopsTheBus) {
    Robot robot;
    robot.start();
    EXPECT_FALSE(robot.bus.stopped);
    robot.subscriptions.reset();
    EXPECT_TRUE(robot.bus.stopped);
}

}  // namespace subscriptions_test
}  // namespace dynamic_filter::live
