// SPDX-License-Identifier: MIT
#include "recording/bag_scans.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "support/bag_recording.hpp"

namespace dynamic_filter::io {
namespace bag_scans_test {

using BagScansTest = BagFiles;

TEST_F(BagScansTest, PosesComeThroughTheFramesAtTheStampOfTheScan) {
    scans(5, "lidar");
    transform("base", "lidar", moved(0, 0, 1.5), kStart, "/tf_static");
    transform("map", "odom", moved(100, 0, 0), kStart - 1.0);
    transform("map", "odom", moved(100, 0, 0), kStart + 2.0);
    transform("map", "odom", moved(100, 0, 0), kStart + 0.5);
    for (double t = -0.93; t < 2.0; t += 0.07) transform("odom", "base", moved(t), kStart + t);
    transform("map", "odom", moved(100, 0, 0), kStart - 0.2);
    const Recording recording = opened();
    EXPECT_EQ(recording.info().layout, "bag");
    ASSERT_EQ(recording.size(), 5U);
    EXPECT_TRUE(has_note(recording, "'lidar' in 'map'"));
    for (std::size_t i = 0; i < 5; ++i) {
        const FullScan full = recording.read(i);
        EXPECT_NEAR(full.stamp, stamp(i), 1e-6);
        const Eigen::Vector3d expected(100.0 + 0.1 * static_cast<double>(i), 0, 1.5);
        EXPECT_TRUE(full.T_world_sensor.translation().isApprox(expected, 1e-6));
        EXPECT_FLOAT_EQ(full.points[0].x(), 5.0F + static_cast<float>(i));
        EXPECT_EQ(stem(recording, i), "00000" + std::to_string(i));
    }
}

TEST_F(BagScansTest, OdometryReachesTheSensorByTheFrames) {
    scans(3, "lidar");
    transform("base", "lidar", moved(0, 0.5, 0), kStart, "/tf_static");
    drive("odom", "base");
    const Recording recording = opened();
    EXPECT_TRUE(has_note(recording, "'base' to 'lidar' by /tf"));
    const Eigen::Vector3d expected(0.2, 0.5, 0);
    EXPECT_TRUE(recording.read(2).T_world_sensor.translation().isApprox(expected, 1e-6));
}

TEST_F(BagScansTest, CloudsOfAVehicleAreSeenFromItsOnlyLidar) {
    scans(3, "base");
    transform("base", "velodyne_base", moved(0, 0.5, 0), kStart, "/tf_static");
    transform("velodyne_base", "velodyne", moved(0, 0, 1), kStart, "/tf_static");
    transform("base", "camera", moved(2, 0, 0), kStart, "/tf_static");
    drive("odom", "base");
    const Recording recording = opened();
    EXPECT_TRUE(
        has_note(recording, "'base' are seen from 'velodyne', which is at (0.00, 0.50, 1.00)"));
    const FullScan full = recording.read(2);
    EXPECT_TRUE(full.T_world_sensor.translation().isApprox(Eigen::Vector3d(0.2, 0.5, 1), 1e-6));
    EXPECT_NEAR(full.points[0].x(), 7.0, 1e-5);
    OpenOptions options;
    options.sensor_at = Eigen::Vector3d::Zero();
    EXPECT_NEAR(opened(options).read(2).T_world_sensor.translation().z(), 0.0, 1e-6);
}

TEST_F(BagScansTest, OfSeveralLidarsNoneIsTaken) {
    scans(3, "base");
    for (const char* name : {"lidar_left", "lidar_right"}) {
        transform("base", name, moved(0, 0.5, 0), kStart, "/tf_static");
    }
    drive("odom", "base");
    EXPECT_FALSE(opened().info().sensor_at);
}

TEST_F(BagScansTest, FramesThatNothingLinksAreTakenForTheSameAndThatIsSaid) {
    scans(3, "lidar");
    drive("odom", "base");
    const Recording recording = opened();
    EXPECT_TRUE(has_note(recording, "no transform links"));
    EXPECT_NEAR(recording.read(2).T_world_sensor.translation().x(), 0.2, 1e-6);
}

TEST_F(BagScansTest, PointsInTheFrameOfTheOdometryAreTakenBack) {
    scans(3, "camera_init");
    drive("camera_init", "body");
    const Recording recording = opened();
    EXPECT_TRUE(recording.info().points_in_world);
    const FullScan full = recording.read(2);
    EXPECT_NEAR(full.T_world_sensor.translation().x(), 0.2, 1e-6);
    EXPECT_NEAR(full.points[0].x(), 7.0 - 0.2, 1e-5);
}

TEST_F(BagScansTest, TopicsToChooseFromAreNamed) {
    scans(2, "lidar", "/front");
    scans(3, "lidar", "/rear");
    drive("odom", "lidar");
    EXPECT_HAS(failure<ConfigError>(), "/front (2 scans), /rear (3 scans)");
    OpenOptions options;
    options.topic = "/rear";
    EXPECT_EQ(opened(options).size(), 3U);
    options.topic = "/side";
    EXPECT_HAS(failure<ConfigError>(options), "there are: /front, /rear");
    options.topic = "/rear";
    options.pose_topic = "/pose";
    EXPECT_HAS(failure<ConfigError>(options), "there are: /odom");
}

TEST_F(BagScansTest, WhatConvertSplitIsNoChoice) {
    for (const char* topic : {"/points", "/points_static", "/points_dynamic", "/static_map"}) {
        scans(2, "lidar", topic);
    }
    drive("odom", "lidar");
    EXPECT_TRUE(has_note(opened(), "scans from /points"));
}

TEST_F(BagScansTest, PosesMayComeFromAFile) {
    scans(5, "lidar");
    OpenOptions options;
    options.poses = data.put("poses.tum", tum_rows(30, kStart - 1.0));  // 1 m in 0.2 s
    const Recording recording = opened(options);
    EXPECT_NEAR(recording.read(3).T_world_sensor.translation().x(), 5.0 + 1.5, 1e-6);
    options.poses = data.put("five.txt", kitti_rows(5));
    EXPECT_EQ(opened(options).read(3).T_world_sensor.translation().x(), 3.0);
    options.poses = data.put("four.txt", kitti_rows(4));
    EXPECT_HAS(failure(options), "4 poses without stamps for 5 scans");
    options.poses = data.put("other.tum", tum_rows(30, 5e5));
    EXPECT_HAS(failure(options), "another clock");
    options.poses.reset();
    EXPECT_FALSE(opened(options).info().has_poses);
    EXPECT_TRUE(has_note(opened(options), "no poses of the frame 'lidar'"));
}

TEST_F(BagScansTest, ScansBeyondThePosesAreRejectedOneByOne) {
    scans(5, "lidar");
    drive("odom", "lidar", -1.0, 0.05);
    const Recording recording = opened();
    EXPECT_EQ(recording.size(), 5U);
    EXPECT_FLOAT_EQ(recording.read(0).points.at(0).x(), 5.0F);
    EXPECT_HAS(error_of([&] { (void)recording.read(4); }), "no pose is known at its time");
}

TEST_F(BagScansTest, ScansBetweenSparsePosesAreLeftToTheOdometry) {
    scans(21, "lidar");
    for (const double t : {0.0, 1.0, 2.0}) transform("odom", "lidar", moved(t), kStart + t);
    const Recording recording = opened();
    EXPECT_TRUE(recording.info().sparse_poses);
    EXPECT_TRUE(has_note(recording, "poses at 1 of 10 scans"));
    ASSERT_EQ(recording.info().trajectory.stamps.size(), 3U);
    EXPECT_EQ(recording.info().trajectory.poses[2].translation().x(), 2.0);
    for (std::size_t i = 0; i < 21; ++i) {
        EXPECT_EQ(recording.info().T_world_sensor[i].matrix().allFinite(), i % 10 == 0) << i;
    }
}

TEST_F(BagScansTest, CorrectionsOfAMapHoldUntilTheNextOne) {
    scans(21, "lidar");
    for (double t = -0.5; t < 2.5; t += 0.05) transform("odom", "lidar", moved(t), kStart + t);
    for (const double t : {0.52, 1.52}) transform("map", "odom", moved(t), kStart + t);
    const Recording recording = opened();
    EXPECT_FALSE(recording.info().sparse_poses);
    for (std::size_t i = 0; i < 21; ++i) {
        const double correction = i < 16 ? 0.52 : 1.52;
        EXPECT_NEAR(recording.read(i).T_world_sensor.translation().x(),
                    correction + 0.1 * static_cast<double>(i), 1e-6)
            << i;
    }
}

TEST_F(BagScansTest, ScansThatCannotBeReadAreLossesAndOtherMessagesAreNot) {
    scans(2, "lidar");
    drive("odom", "lidar");
    write("/odom", "nav_msgs/Odometry", stamp(0), std::vector<std::byte>(3));
    EXPECT_TRUE(opened().info().losses.empty());
    EXPECT_TRUE(has_note(opened(), "1 messages cannot be read"));
    writer_ = BagWriter::create(data / "a.mcap");
    scans(2, "lidar");
    drive("odom", "lidar");
    write("/points", "sensor_msgs/PointCloud2", stamp(2), std::vector<std::byte>(3));
    ASSERT_EQ(opened().info().losses.size(), 1U);
    EXPECT_HAS(opened().info().losses[0], "the first is of /points");
}

TEST_F(BagScansTest, ScansAreInTheOrderOfTheirStamps) {
    for (const std::size_t i : {2U, 0U, 1U, 3U}) scan(i, "lidar", "/points", stamp(i));
    drive("odom", "lidar");
    OpenOptions options;
    options.first = 1;
    options.stride = 2;
    const Recording recording = opened(options);
    ASSERT_EQ(recording.size(), 2U);
    EXPECT_FLOAT_EQ(recording.read(0).points[0].x(), 6.0F);
    EXPECT_FLOAT_EQ(recording.read(1).points[0].x(), 8.0F);
    EXPECT_EQ(stem(recording, 1), "000003");
}

TEST_F(BagScansTest, MessagesThatAreNoneAreCountedAndTheOthersGoOn) {
    scans(3, "lidar");
    write("/points", "sensor_msgs/PointCloud2", stamp(3), std::vector<std::byte>(7));
    write("/odom", "nav_msgs/Odometry", stamp(3), {});
    Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, FieldType::f32);
    cloud.data.resize(4 * cloud.point_bytes);
    auto cut = cloud_message(cloud, stamp(3), "lidar", MessageEncoding::cdr);
    cut.resize(cut.size() - 20);
    write("/points", "sensor_msgs/PointCloud2", stamp(3), cut);
    drive("odom", "lidar");
    const Recording recording = opened();
    ASSERT_EQ(recording.info().losses.size(), 1U);
    EXPECT_HAS(recording.info().losses[0],
               "2 messages cannot be read and are left out; the first is of /p");
    ASSERT_EQ(recording.size(), 4U);
    EXPECT_FLOAT_EQ(recording.read(2).points.at(0).x(), 7.0F);
    EXPECT_HAS(error_of([&] { (void)recording.read(3); }), "a.mcap (scan 3 of /points)");
}

TEST_F(BagScansTest, HeadersWithoutStampsHaveTheTimeOfRecording) {
    Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, FieldType::f32);
    cloud.data.resize(cloud.point_bytes);
    for (std::size_t i = 0; i < 3; ++i) {
        write("/points", "sensor_msgs/PointCloud2", stamp(i),
              cloud_message(cloud, 0.0, "lidar", MessageEncoding::cdr));
    }
    drive("odom", "lidar");
    const Recording recording = opened();
    EXPECT_TRUE(has_note(recording, "times of recording"));
    EXPECT_NEAR(recording.info().stamps[2], stamp(2), 1e-6);
}

TEST_F(BagScansTest, OfSeveralPosesTheFirstIsTakenAndThatIsSaid) {
    scans(3, "lidar");
    drive("odom", "lidar");
    odometry("map", "lidar", moved(9), kStart, "/slam");
    EXPECT_TRUE(has_note(opened(), "(of /odom, /slam; choose with --pose-topic)"));
}

TEST_F(BagScansTest, MotionIsUndoneWhenAsked) {
    scans(3, "lidar");
    drive("odom", "lidar");
    OpenOptions options;
    options.deskew = true;
    const Recording recording = opened(options);
    EXPECT_TRUE(recording.info().deskewed);
    // The second point was measured 50 ms later, 5 cm farther along x.
    EXPECT_NEAR(recording.read(1).points[1].x(), 0.05, 1e-4);
    EXPECT_NEAR(recording.read(1).points[0].x(), 6.0, 1e-4);
}

TEST_F(BagScansTest, ABagWithoutScansSaysWhatWasLookedFor) {
    drive("odom", "lidar");
    EXPECT_HAS(failure(), "holds no point clouds");
}

}  // namespace bag_scans_test
}  // namespace dynamic_filter::io
