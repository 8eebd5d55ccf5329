// SPDX-License-Identifier: MIT
#include "dynamic_filter/recording.hpp"

#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace open_recording_test {

using OpenRecording = RecordingFiles;

TEST_F(OpenRecording, KittiWithoutCalibration) {
    put_bins("velodyne", 12);
    data.put("poses.txt", kitti_rows(12));
    const Recording recording = open();
    EXPECT_EQ(recording.info().layout, "kitti");
    ASSERT_EQ(recording.size(), 12U);
    EXPECT_EQ(stem(recording, 10), "000010");
    EXPECT_EQ(recording.info().T_world_sensor[10].translation().x(), 10.0);
    EXPECT_FALSE(recording.info().measured_stamps);
    EXPECT_TRUE(has_note(recording, "10 Hz"));
    EXPECT_DOUBLE_EQ(recording.info().stamps[3], 0.3);
    EXPECT_FALSE(recording.info().has_truth());
}

TEST_F(OpenRecording, KittiCameraPoses) {
    put_bins("velodyne", 2);
    data.put("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 5\n");
    data.put("calib.txt", "Tr: 0 -1 0 1 0 0 -1 2 1 0 0 3\n");
    const Recording recording = open();
    EXPECT_TRUE(has_note(recording, "camera"));
    // The camera looks along z, the LiDAR along x.
    EXPECT_TRUE(
        recording.info().T_world_sensor[1].translation().isApprox(Eigen::Vector3d(5, 0, 0), 1e-12));
    EXPECT_TRUE(recording.info().T_world_sensor[1].linear().isIdentity(1e-12));
    OpenOptions options;
    options.pose_fix = PoseFix::lidar;  // they are the LiDAR's, whatever lies beside them
    EXPECT_EQ(open(options).info().T_world_sensor[1].translation(), Eigen::Vector3d(0, 0, 5));
    data.put("calib.txt", "P0: 1\n");
    EXPECT_HAS(open_error(), "Tr:");
}

TEST_F(OpenRecording, MotionsAreJoinedBeforeScansAreSelected) {
    put_bins("velodyne", 6);
    std::string rows;
    for (int i = 0; i < 6; ++i) rows += "1 0 0 2 0 1 0 0 0 0 1 0\n";
    data.put("poses.txt", rows);
    OpenOptions options;
    options.pose_fix = PoseFix::relative;
    options.first = 1;
    options.stride = 2;
    const Recording recording = open(options);
    ASSERT_EQ(recording.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        const double way = 4.0 + 4.0 * static_cast<double>(i);
        EXPECT_EQ(recording.info().T_world_sensor[i].translation().x(), way);
    }
}

TEST_F(OpenRecording, MotionsAreThoseOfAPoseFileWithARowForEachScan) {
    for (const char* name : {"1500000000000000000", "1500000000500000000"}) {
        data.put("Ouster/" + std::string(name) + ".bin", floats({1, 2, 3, 4}));
    }
    data.put("global_pose.csv",
             "1500000000000000000,1,0,0,10,0,1,0,20,0,0,1,30\n"
             "1500000001000000000,1,0,0,12,0,1,0,20,0,0,1,30\n");
    OpenOptions options;
    options.pose_fix = PoseFix::relative;
    EXPECT_THROW((void)open(options), ConfigError);  // these are poses of a vehicle at other times
}

TEST_F(OpenRecording, Stamps) {
    put_bins("velodyne", 3);
    data.put("poses.txt", kitti_rows(3));
    data.put("times.txt", "1\n1.1\n1.3\n");
    EXPECT_TRUE(open().info().measured_stamps);
    EXPECT_EQ(open().info().stamps[2], 1.3);
    data.put("times.txt", "1\n1\n1\n");
    EXPECT_FALSE(open().info().measured_stamps);
    EXPECT_TRUE(has_note(open(), "equal"));
    EXPECT_DOUBLE_EQ(open().info().stamps[2], 0.2);
    data.put("times.txt", "1\n2\n");
    EXPECT_HAS(open_error(), "2 times but 3 scans");
    data.put("times.txt", "1\n3\n2\n");
    EXPECT_HAS(open_error(), "must not go back");
}

TEST_F(OpenRecording, ScansMustNotGoBackInTime) {
    for (const char* stamp : {"5", "3"}) {
        const std::string submap = stamp == std::string("5") ? "000000/" : "000001/";
        data.put(submap + "data.txt",
                 "T_world_origin:\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\nstamp: " +
                     std::string(stamp) + "\n");
        data.put(submap + "points_compact.bin", floats({1, 2, 3}));
    }
    EXPECT_HAS(open_error(), "000001: its time is before");
}

TEST_F(OpenRecording, WhyMotionIsNotUndone) {
    OpenOptions options;
    options.deskew = true;
    put_bins("velodyne", 3);
    data.put("poses.txt", kitti_rows(3));
    EXPECT_TRUE(has_note(open(options), "no poses over time"));
    data.put("times.txt", "1\n1.1\n1.2\n");
    EXPECT_TRUE(has_note(open(options), "no times of their own"));
    EXPECT_FALSE(open(options).info().deskewed);
}

TEST_F(OpenRecording, TopicsAreForBags) {
    put_bins("velodyne", 1);
    data.put("poses.txt", kitti_rows(1));
    OpenOptions options;
    options.topic = "/points";
    EXPECT_HAS(error_of<ConfigError>([&] { (void)open(options); }), "for bags");
}

TEST_F(OpenRecording, SelectionKeepsThingsParallel) {
    put_bins("velodyne", 10);
    put_labels(10);
    data.put("poses.txt", kitti_rows(10));
    OpenOptions options;
    options.first = 2;
    options.last = 8;
    options.stride = 3;
    const Recording recording = open(options);
    ASSERT_EQ(recording.size(), 3U);
    EXPECT_EQ(stem(recording, 1), "000005");
    EXPECT_EQ(recording.info().label_files[1].stem(), "000005");
    EXPECT_EQ(recording.info().T_world_sensor[1].translation().x(), 5.0);
    EXPECT_DOUBLE_EQ(recording.info().stamps[1], 0.5);
    options.last = 1000;
    options.stride = std::numeric_limits<std::size_t>::max();
    EXPECT_EQ(open(options).size(), 1U);
}

TEST_F(OpenRecording, SelectionErrors) {
    put_bins("velodyne", 3);
    data.put("poses.txt", kitti_rows(3));
    const auto error = [&](const OpenOptions& options) {
        return error_of<ConfigError>([&] { (void)open(options); });
    };
    OpenOptions options;
    options.first = 3;
    EXPECT_HAS(error(options), "--first 3");
    options.last = 2;
    EXPECT_HAS(error(options), "--last 2");
    options = {};
    options.stride = 0;
    EXPECT_HAS(error(options), "--stride");
}

TEST_F(OpenRecording, FolderWithTum) {
    put_bins("Scans", 3);
    data.put("GlobalMap.pcd", "not a scan");
    data.put("track.tum", tum_rows(3));
    const Recording recording = open();
    EXPECT_EQ(recording.info().layout, "folder");
    ASSERT_EQ(recording.size(), 3U);
    EXPECT_TRUE(recording.info().measured_stamps);
    EXPECT_DOUBLE_EQ(recording.info().stamps[2], 0.4);
    EXPECT_TRUE(has_note(recording, "by order"));
    EXPECT_EQ(recording.read(2).points, (Points{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_THROW((void)recording.read(recording.size()), InputError);
}

}  // namespace open_recording_test
}  // namespace dynamic_filter::io
