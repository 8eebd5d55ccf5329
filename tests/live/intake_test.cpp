// SPDX-License-Identifier: MIT
#include "live/intake.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/bag.hpp"

namespace dynamic_filter::live {
namespace intake_test {

constexpr auto kCdr = io::MessageEncoding::cdr;
const io::Topic kPoints{"/points", "sensor_msgs/PointCloud2", kCdr};
const io::Topic kTf{"/tf", "tf2_msgs/TFMessage", kCdr};
const io::Topic kTfStatic{"/tf_static", "tf2_msgs/TFMessage", kCdr};
const io::Topic kOdometry{"/odom", "nav_msgs/Odometry", kCdr};

Bytes shared(std::vector<std::byte> bytes) {
    return std::make_shared<const std::vector<std::byte>>(std::move(bytes));
}

Pose at(double x) { return Pose(Eigen::Translation3d(x, 0.0, 0.0)); }

io::Cloud cloud_of(const Points& points) {
    io::Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) io::add_field(cloud, axis, io::FieldType::f32);
    for (const Point& p : points) {
        const auto* bytes = reinterpret_cast<const std::byte*>(p.data());
        cloud.data.insert(cloud.data.end(), bytes, bytes + 3 * sizeof(float));
    }
    return cloud;
}

Bytes cloud_at(double stamp, const std::string& frame = "lidar") {
    return shared(io::cloud_message(cloud_of({{1, 2, 3}, {4, 5, 6}}), stamp, frame, kCdr));
}
Bytes link(const std::string& parent, const std::string& child, const Pose& pose, double stamp) {
    return shared(io::transform_message(parent, child, pose, stamp, kCdr));
}
Bytes odometry(const std::string& parent, const std::string& child, double x, double stamp) {
    return shared(io::odometry_message(parent, child, at(x), stamp, kCdr));
}

struct IntakeOf {
    LiveConfig config;
    std::optional<Intake> intake;
    IntakeOf() : IntakeOf(std::vector<std::pair<std::string, std::string>>{}) {}
    IntakeOf(const std::string& key, const std::string& value)
        : IntakeOf(std::vector<std::pair<std::string, std::string>>{{key, value}}) {}
    explicit IntakeOf(const std::vector<std::pair<std::string, std::string>>& settings) {
        config.input.wait = 0.05;
        for (const auto& [key, value] : settings) set(config, key, value);
        intake.emplace(config);
    }
    Intake* operator->() { return &*intake; }
    std::optional<LiveScan> pop() { return intake->pop(0.5); }
    std::string notices() {
        std::string all;
        for (const std::string& notice : intake->pop_notices()) all += notice + "\n";
        return all;
    }
};

TEST(Intake, PosesAreInterpolatedBetweenThoseAroundTheScan) {
    IntakeOf intake;
    intake->put(kTfStatic, true, link("base", "lidar", at(0.5), 0.0));
    intake->put(kTf, false, link("map", "base", at(10.0), 100.0));
    intake->put(kPoints, false, cloud_at(100.25));
    intake->put(kTf, false, link("map", "base", at(20.0), 100.5));
    const auto scan = intake.pop();
    ASSERT_TRUE(scan);
    EXPECT_TRUE(scan->has_pose);
    EXPECT_NEAR(scan->T_world_sensor.translation().x(), 15.5, 1e-9);
    EXPECT_EQ(scan->world, "map");
    EXPECT_EQ(scan->frame, "lidar");
    EXPECT_EQ(scan->points.size(), 2U);
    EXPECT_EQ(scan->stamp_ns, 100'250'000'000);
    EXPECT_EQ(intake->origin(), PoseOrigin::frames);
}

TEST(Intake, ScansOfSeveralSensorsHaveTheirNumbersAndPoses) {
    const std::vector<std::pair<std::string, std::string>> settings = {
        {"input.cloud", "/front /rear"}, {"input.decide", "0"}};
    IntakeOf intake(settings);
    const auto cloud_on = [&](const std::string& name, double stamp) {
        intake->put({"/" + name, "sensor_msgs/PointCloud2", kCdr}, false, cloud_at(stamp, name));
    };
    cloud_on("rear", 99.0);
    EXPECT_FALSE(intake.pop()) << "odometry follows one sensor alone";
    EXPECT_NE(intake->poses_text().find("several sensors need them"), std::string::npos);
    intake->put(kTfStatic, true, link("base", "front", at(1.0), 0.0));
    intake->put(kTfStatic, true, link("base", "rear", at(-1.0), 0.0));
    for (const double stamp : {100.0, 101.0}) {
        intake->put(kTf, false, link("map", "base", at(stamp), stamp));
    }
    cloud_on("rear", 100.5);
    cloud_on("front", 100.4);  // it was longer on its way
    const auto rear = intake.pop(), front = intake.pop();
    ASSERT_TRUE(rear && front);
    EXPECT_EQ(rear->sensor, 1U);
    EXPECT_EQ(front->sensor, 0U);
    EXPECT_NEAR(rear->T_world_sensor.translation().x(), 99.5, 1e-9);
    EXPECT_NEAR(front->T_world_sensor.translation().x(), 101.4, 1e-9);
}

TEST(Intake, AScanWaitsForALatePose) {
    IntakeOf intake("input.wait", "5");
    intake->put(kTf, false, link("map", "lidar", at(0.0), 99.9));
    intake->put(kPoints, false, cloud_at(100.0));
    EXPECT_FALSE(intake->pop(0.05)) << "the pose after it is not there yet";
    intake->put(kTf, false, link("map", "lidar", at(2.0), 100.1));
    const auto scan = intake.pop();
    ASSERT_TRUE(scan);
    EXPECT_NEAR(scan->T_world_sensor.translation().x(), 1.0, 1e-6);
}

TEST(Intake, AScanWaitsForTheSecondTransform) {
    IntakeOf intake("input.wait", "5");
    intake->put(kTf, false, link("map", "lidar", at(1.0), 100.0));
    intake->put(kPoints, false, cloud_at(100.0));
    EXPECT_FALSE(intake->pop(0.05)) << "it is not known yet whether the frame moves";
    intake->put(kTf, false, link("map", "lidar", at(2.0), 100.1));
    const auto scan = intake.pop();
    ASSERT_TRUE(scan);
    EXPECT_NEAR(scan->T_world_sensor.translation().x(), 1.0, 1e-6);
}

TEST(Intake, ScansWithoutPosesAreCountedAndExplained) {
    IntakeOf intake("input.pose", "/tf");
    intake->put(kPoints, false, cloud_at(100.0));
    EXPECT_FALSE(intake.pop());
    EXPECT_NE(intake->poses_text().find("does not know the frame 'lidar'"), std::string::npos);

    intake->put(kTfStatic, true, link("base", "lidar", at(0.5), 0.0));
    intake->put(kPoints, false, cloud_at(100.1));
    EXPECT_FALSE(intake.pop());
    EXPECT_NE(intake->poses_text().find("nothing between them moves"), std::string::npos)
        << intake->poses_text();

    intake->put(kTf, false, link("map", "base", at(0.0), 5000.0));
    intake->put(kTf, false, link("map", "base", at(0.0), 5000.1));
    intake->put(kPoints, false, cloud_at(100.2));
    EXPECT_FALSE(intake.pop());
    EXPECT_NE(intake->poses_text().find("clocks differ"), std::string::npos)
        << intake->poses_text();
    EXPECT_EQ(intake->counters().without_pose, 3U);
    EXPECT_EQ(intake->counters().received, 3U);
    EXPECT_EQ(intake->counters().taken, 0U);
}

TEST(Intake, ATopicOfPosesServesWhereThereIsNoTf) {
    IntakeOf intake;
    intake->put(kOdometry, false, odometry("odom", "lidar", 1.0, 10.0));
    intake->put(kOdometry, false, odometry("odom", "lidar", 2.0, 10.2));
    intake->put(kPoints, false, cloud_at(10.1));
    const auto scan = intake.pop();
    ASSERT_TRUE(scan);
    EXPECT_NEAR(scan->T_world_sensor.translation().x(), 1.5, 1e-6);
    EXPECT_EQ(intake->origin(), PoseOrigin::topic);
    EXPECT_NE(intake.notices().find("poses from /odom"), std::string::npos);
}

TEST(Intake, PointsInTheFrameOfTheWorldAreBroughtToTheSensor) {
    IntakeOf intake;
    intake->put(kOdometry, false, odometry("odom", "body", 1.0, 10.0));
    intake->put(kOdometry, false, odometry("odom", "body", 1.0, 10.2));
    intake->put(kPoints, false, cloud_at(10.1, "odom"));
    const auto scan = intake.pop();
    ASSERT_TRUE(scan);
    EXPECT_NEAR(scan->points[0].x(), 0.0F, 1e-5F);
    EXPECT_EQ(scan->frame, "odom");
}

TEST(Intake, OwnOdometryBeginsIfNoPoseComes) {
    IntakeOf intake("input.decide", "0.1");
    std::optional<LiveScan> scan;
    for (int i = 0; i < 200 && !scan; ++i) {
        intake->put(kPoints, false, cloud_at(100.0 + 0.1 * i));
        scan = intake->pop(0.1);
    }
    ASSERT_TRUE(scan);
    EXPECT_FALSE(scan->has_pose);
    EXPECT_EQ(scan->root, "lidar");
    EXPECT_NE(intake.notices().find("found by odometry"), std::string::npos);
}

TEST(Intake, TheRootOfTfIsKeptForTheOwnOdometry) {
    IntakeOf intake("input.pose", "none");
    intake->put(kTf, false, link("odom", "lidar", at(3.0), 100.0));
    intake->put(kTf, false, link("odom", "lidar", at(5.0), 100.2));
    intake->put(kPoints, false, cloud_at(100.1));
    const auto scan = intake.pop();
    ASSERT_TRUE(scan);
    EXPECT_FALSE(scan->has_pose);
    EXPECT_EQ(scan->root, "odom");
    ASSERT_TRUE(scan->T_root_sensor);
    EXPECT_NEAR(scan->T_root_sensor->translation().x(), 4.0, 1e-6);
}

TEST(Intake, AClockThatIsSetBackForgetsPosesOfTheOldTime) {
    IntakeOf intake;
    const auto drive = [&](double from) {
        for (double t = from; t < from + 1.0; t += 0.1) {
            intake->put(kTf, false, link("map", "lidar", at(t), t));
        }
        intake->put(kPoints, false, cloud_at(from + 0.55));
        return intake.pop();
    };
    ASSERT_TRUE(drive(5000.0));
    const auto back = drive(1400.0);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->T_world_sensor.translation().x(), 1400.55, 1e-6);
    EXPECT_NE(intake.notices().find("went back"), std::string::npos);
    const auto ahead = drive(5000.0);
    ASSERT_TRUE(ahead);
    EXPECT_NEAR(ahead->T_world_sensor.translation().x(), 5000.55, 1e-6);
    EXPECT_EQ(intake->counters().without_pose, 0U);
}

TEST(Intake, FaultyMessagesAreCountedAndDoNoHarm) {
    IntakeOf intake("input.pose", "none");
    auto cut = io::cloud_message(cloud_of({{1, 2, 3}}), 1.0, "lidar", kCdr);
    cut.resize(cut.size() / 2);
    intake->put(kPoints, false, shared(cut));
    intake->put(kPoints, false, shared({}));
    intake->put(kPoints, false, shared(io::cloud_message(cloud_of({}), 1.0, "lidar", kCdr)));
    auto negative = *cloud_at(5.0);
    for (std::size_t i = 4; i < 8; ++i) negative[i] = std::byte{0xFF};  // the seconds
    intake->put(kPoints, false, shared(negative));
    intake->put(kTf, false, shared({std::byte{0}}));
    intake->put(kPoints, false, cloud_at(1.0));
    EXPECT_TRUE(intake.pop());
    EXPECT_EQ(intake->counters().malformed, 4U);
    EXPECT_EQ(intake->counters().other_malformed, 1U);
    EXPECT_EQ(intake->counters().taken, 1U);
}

TEST(Intake, MemoryIsBoundedWhenNobodyTakes) {
    IntakeOf intake("input.pose", "none");
    for (int i = 0; i < 1000; ++i) intake->put(kPoints, false, cloud_at(1.0 + 0.1 * i));
    for (int i = 0; i < 10000; ++i) {
        intake->put(kTf, false, link("map", "frame" + std::to_string(i), at(0.0), 1.0));
    }
    std::uint64_t taken = 0;
    while (intake->pop(0.0)) ++taken;
    const IntakeCounters counters = intake->counters();
    EXPECT_EQ(counters.received, 1000U);
    EXPECT_EQ(counters.overrun, 1000U - taken);
    EXPECT_EQ(counters.taken, taken);
    EXPECT_LE(taken, 20U);
    EXPECT_GT(counters.other_overrun, 5000U);
}

TEST(Intake, MotionIsUndoneByThePosesDuringTheScan) {
    IntakeOf intake("input.deskew", "true");
    io::Cloud cloud = cloud_of({});
    io::add_field(cloud, "t", io::FieldType::f32);
    for (const float time : {0.0F, 0.05F, 0.1F}) {
        for (const float value : {5.0F, 0.0F, 0.0F, time}) {
            const auto* bytes = reinterpret_cast<const std::byte*>(&value);
            cloud.data.insert(cloud.data.end(), bytes, bytes + sizeof value);
        }
    }
    for (const double t : {10.0, 10.05, 10.1, 10.15}) {
        intake->put(kTf, false, link("map", "lidar", at(10.0 * (t - 10.0)), t));
    }
    intake->put(kPoints, false, shared(io::cloud_message(cloud, 10.0, "lidar", kCdr)));
    const auto scan = intake.pop();
    ASSERT_TRUE(scan);
    EXPECT_TRUE(scan->times.empty());
    EXPECT_NEAR(scan->points[0].x(), 5.0F, 1e-3F);
    EXPECT_NEAR(scan->points[1].x(), 5.5F, 1e-3F);
    EXPECT_NEAR(scan->points[2].x(), 6.0F, 1e-3F);
    EXPECT_GE(scan->trajectory.stamps.size(), 2U);
}

}  // namespace intake_test
}  // namespace dynamic_filter::live
