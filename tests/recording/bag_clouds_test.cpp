// SPDX-License-Identifier: MIT
#include "recording/bag_clouds.hpp"

#include "recording/recording_parts.hpp"
#include "support/bag_recording.hpp"
#include "support/pillars.hpp"

namespace dynamic_filter::io {
namespace bag_clouds_test {

class BagCloudsTest : public BagFiles {
protected:
    void view(double scan, double at) {
        put(pillars_seen_from(on_a_curve(scan)), "lidar", "/points", kStart + at);
    }
};

TEST_F(BagCloudsTest, CopiesWithTheSameStampAreLeftOut) {
    for (int copy = 0; copy < 2; ++copy) {
        for (int i = 0; i < 4; ++i) view(i, 0.1 * i);
    }
    drive("odom", "lidar");
    const Recording recording = opened();
    EXPECT_EQ(recording.size(), 4U);
    EXPECT_TRUE(has_note(recording, "4 clouds are in the bag more than once"));
    EXPECT_TRUE(recording.info().losses.empty());
}

TEST_F(BagCloudsTest, OtherCloudsWithTheSameStampAreScans) {
    for (int i = 0; i < 4; ++i) view(i, 0.1 * (i / 2));
    drive("odom", "lidar");
    EXPECT_EQ(opened().size(), 4U);
}

TEST_F(BagCloudsTest, ACloudThatADriverRepeatsIsRejected) {
    for (int i = 0; i < 6; ++i) view(i == 3 ? 2 : i, 0.1 * i);
    drive("odom", "lidar");
    const Recording recording = opened();
    ASSERT_EQ(recording.size(), 6U);
    EXPECT_NE(error_of([&] { (void)recording.read(3); }).find("repeats the scan before it"),
              std::string::npos);
    EXPECT_NO_THROW((void)recording.read(4));
}

TEST_F(BagCloudsTest, EachOfSeveralSensorsHasItsPoses) {
    const Pose rear = moved(-1.5) * Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitZ());
    for (std::size_t i = 0; i < 4; ++i) {
        scan(i, "front", "/points", stamp(i));
        scan(i, "rear", "/points", stamp(i) + 0.001);
    }
    transform("base", "front", moved(0.5), kStart, "/tf_static");
    transform("base", "rear", rear, kStart, "/tf_static");
    for (double t = -0.2; t < 1.0; t += 0.05) transform("odom", "base", moved(t), kStart + t);
    const Recording recording = opened();
    ASSERT_EQ(recording.size(), 8U);
    EXPECT_TRUE(recording.info().losses.empty());
    EXPECT_TRUE(has_note(recording, "those of 2 sensors, which take turns"));
    EXPECT_TRUE(recording.read(4).T_world_sensor.isApprox(moved(0.7), 1e-6));
    EXPECT_TRUE(recording.read(5).T_world_sensor.isApprox(moved(0.201) * rear, 1e-6));
    const auto sensors = by_sensor(recording);
    ASSERT_EQ(sensors.size(), 2U);
    EXPECT_NEAR(sensors[1].info().stamps[2], stamp(2) + 0.001, 1e-6);
    // The second point was measured 50 ms later, 5 cm farther along x of the world.
    const Point seen = sensors[1].read(2).points[1];
    const Point still = deskewed(sensors[1]).read(2).points[1];
    const Eigen::Vector3d way = rear.linear() * (still - seen).cast<double>();
    EXPECT_TRUE(way.isApprox(Eigen::Vector3d(0.05, 0, 0), 1e-3));
    OpenOptions options;
    options.without_poses = true;
    EXPECT_EQ(opened(options).size(), 4U) << "odometry follows one sensor";
    EXPECT_EQ(opened(options).info().losses.size(), 1U);
}

TEST_F(BagCloudsTest, CloudsOfSeveralFramesWithoutTheirPosesAreNamedAndOneFrameIsRead) {
    for (std::size_t i = 0; i < 3; ++i) scan(i, "front", "/points", stamp(i));
    for (std::size_t i = 0; i < 4; ++i) scan(i, "rear", "/points", stamp(i) + 0.001);
    drive("odom", "front");
    const Recording most = opened();
    EXPECT_EQ(most.size(), 4U);
    ASSERT_EQ(most.info().losses.size(), 1U);
    const std::string loss = most.info().losses.front();
    EXPECT_NE(loss.find("clouds of 2 frames"), std::string::npos);
    EXPECT_NE(loss.find("only those in 'rear' are read; --topic /points@front reads the others"),
              std::string::npos);
    OpenOptions options;
    options.topic = "/points@front";
    const Recording front = opened(options);
    EXPECT_EQ(front.size(), 3U);
    EXPECT_TRUE(front.info().losses.empty());
    options.topic = "/points@left";
    EXPECT_NE(failure<ConfigError>(options).find("in the frame 'left' on topic /points; there are: "
                                                 "'rear' (4 clouds), 'front' (3 clouds)"),
              std::string::npos);
}

}  // namespace bag_clouds_test
}  // namespace dynamic_filter::io
